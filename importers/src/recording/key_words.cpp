#include "recording/key_words.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::recordings {

namespace key_words {

std::string brief(double value) {
  return std::abs(value) < 1e6 ? short_text(value, 4) : brief_text(value);
}

template <class Vector>
std::string vector_text(const Vector& vector) {
  std::string text = "(";
  for (Eigen::Index i = 0; i < vector.size(); ++i) text += (i > 0 ? ", " : "") + brief(vector[i]);
  return text + ")";
}

std::string text_of(double value) {
  return brief(value);
}
std::string text_of(const Vec2& value) {
  return vector_text(value);
}
std::string text_of(const Vec3& value) {
  return vector_text(value);
}
std::string text_of(const Vec4& value) {
  return vector_text(value);
}
std::string text_of(const Color& value) {
  return vector_text(value.rgba);
}
std::string text_of(const Quat& value) {
  const Vec3 turn = log_map(value);
  const double angle = turn.norm();
  if (angle < 1e-9) return "0°";
  return short_text(angle * 180 / std::numbers::pi, 2) + "° about " + vector_text(Vec3(turn / angle));
}

template <class T>
std::string value_text(const Curve<T>& curve, double time) {
  return text_of(curve.value(time));
}
std::string value_text(const WeightCurves& curves, double time) {
  std::string text = "(";
  constexpr std::size_t most = 8;
  for (std::size_t i = 0; i < std::min(most, curves.size()); ++i)
    text += (i > 0 ? ", " : "") + brief(curves[i].value(time));
  return text + (curves.size() > most ? ", ...)" : ")");
}
std::string value_text(const StepCurve<bool>& curve, double time) {
  return curve.value(time) ? "true" : "false";
}
std::string value_text(const StepCurve<std::string>& curve, double time) {
  return curve.value(time);
}

const char* degree_word(int degree) {
  static constexpr const char* words[] = {"hold", "linear", "quadratic", "cubic", "quartic", "quintic"};
  return words[std::clamp(degree, 0, 5)];
}

template <class T>
const char* span_word(const Span<T>& span) {
  return span.warp.function ? "eased" : degree_word(span.degree);
}
const char* span_word(const RotationSpan& span) {
  if (span.warp.function) return "eased";
  if (span.form == RotationSpan::Form::exponential && span.spin.isZero(0)) return degree_word(span.degree);
  return span.form == RotationSpan::Form::normalized && span.degree <= 1 ? "linear" : "cubic";
}

template <class T>
std::vector<std::string> ease_texts(const Curve<T>& curve, const std::vector<double>& times) {
  const std::span<const double> knots = curve.knots();
  const auto spans = curve.spans();
  std::vector<std::string> words;
  for (const double time : times) {
    const auto after = std::upper_bound(spans.begin(), spans.end(), time,
                                        [](double wanted, const auto& span) { return wanted < span.start; });
    if (knots.empty() || time >= knots.back()) {
      words.emplace_back("end");
    } else if (spans.empty()) {
      words.emplace_back("eased");
    } else {
      words.emplace_back(span_word(after == spans.begin() ? spans.front() : *(after - 1)));
    }
  }
  return words;
}
std::vector<std::string> ease_texts(const WeightCurves& curves, const std::vector<double>& times) {
  std::vector<std::string> words(times.size());
  for (const Curve<double>& curve : curves) {
    const std::vector<std::string> own = ease_texts(curve, times);
    for (std::size_t i = 0; i < times.size(); ++i)
      words[i] = words[i].empty() || words[i] == own[i] ? own[i] : std::string("several");
  }
  return words;
}
template <class T>
std::vector<std::string> ease_texts(const StepCurve<T>& curve, const std::vector<double>& times) {
  std::vector<std::string> words;
  words.reserve(times.size());
  for (const double time : times) words.emplace_back(time >= curve.steps().back().first ? "end" : "hold");
  return words;
}

}  // namespace key_words

std::string key_value_text(const Track& track, double clip_time) {
  if (const auto* angle = std::get_if<Curve<double>>(&track.curve); angle && track.property.starts_with("rotation."))
    return short_text(angle->value(clip_time) * 180 / std::numbers::pi, 2) + "°";
  return std::visit([&](const auto& held) { return key_words::value_text(held, clip_time); }, track.curve);
}

std::vector<std::string> key_ease_texts(const Track& track, const std::vector<double>& clip_times) {
  std::vector<std::string> texts =
      std::visit([&](const auto& held) { return key_words::ease_texts(held, clip_times); }, track.curve);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto after = std::upper_bound(track.words.begin(), track.words.end(), clip_times[i],
                                        [](double time, const auto& said) { return time < said.first; });
    const bool is_said = after != track.words.begin() && !(after - 1)->second.empty();
    if (is_said && texts[i] != "end") texts[i] = (after - 1)->second;
  }
  return texts;
}

}  // namespace tweenfall::recordings
