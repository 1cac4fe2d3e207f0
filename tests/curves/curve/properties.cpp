// What holds for every kind of key and every type of value.

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <map>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

namespace {

template <class T>
constexpr bool evaluation_is_noexcept = noexcept(std::declval<const Curve<T>&>().sample(0)) && noexcept(
    std::declval<const Curve<T>&>().value(0)) && noexcept(std::declval<const Curve<T>&>().rate(0));
static_assert(evaluation_is_noexcept<double> && evaluation_is_noexcept<Vec2> && evaluation_is_noexcept<Vec3> &&
              evaluation_is_noexcept<Vec4> && evaluation_is_noexcept<Color> && evaluation_is_noexcept<Quat>);

// A word of `Ease::names`, with numbers in place of the names of its numbers.
std::string with_numbers(const std::string& form) {
  static const std::map<std::string, std::string> numbers = {
      {"exponent", "2.7"}, {"overshoot", "1.2"}, {"amplitude", "1.3"},   {"period", "0.4"}, {"damping", "0.3"},
      {"x1", "0.7"},       {"y1", "-0.4"},       {"x2", "0.3"},          {"y2", "1.5"},     {"tension", "0.2"},
      {"bias", "0.3"},     {"start", "1.5"},     {"continuity", "-0.3"}, {"end", "-2"},     {"count", "3"},
      {"stop", "0"},       {"...", "0.7 30%,1"}, {"jump", "jump-both"}};
  const std::size_t open = form.find('(');
  std::string text = form.substr(0, open);
  for (std::size_t at = open; at < form.size();) {
    const std::size_t end = form.find_first_of(",)", at + 1);
    if (end == std::string::npos) break;
    const auto found = numbers.find(form.substr(at + 1, end - at - 1));
    CHECK_MESSAGE(found != numbers.end(), "no number for what is left of " << form.substr(at + 1));
    if (found != numbers.end()) text += form[at] + found->second;
    at = end;
  }
  return open == std::string::npos ? text : text + ")";
}

bool jumps(const std::string& word) {
  return word == "hold" || word.starts_with("step");
}

Vec4 change(const Color& a, const Color& b) {
  return a.rgba - b.rgba;
}
Vec3 change(const Quat& a, const Quat& b) {
  return log_map(a * b.conjugate());
}
template <class V>
V change(const V& a, const V& b) {
  return a - b;
}

double length(double v) {
  return std::abs(v);
}
template <class V>
double length(const Eigen::MatrixBase<V>& v) {
  return v.norm();
}

double& first_part(double& v) {
  return v;
}
template <class V>
double& first_part(V& v) {
  return v[0];
}

// Of fourth order in h.
template <class F>
auto central_difference(const F& value, double t, double h) {
  using Change = decltype(change(value(t), value(t)));
  return Change((8 * change(value(t + h), value(t - h)) - change(value(t + 2 * h), value(t - 2 * h))) / (12 * h));
}

// Times inside a stretch: not so near its ends that a kink or an infinite rate there would show.
constexpr double shares[] = {0.11, 0.3, 0.52, 0.77, 0.9};

template <class T>
void check_rates(const Curve<T>& curve) {
  const auto knots = curve.knots();
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double duration = knots[i + 1] - knots[i], h = 1e-4 * duration;
    // How far the span moves in its own time: steep spans have large rates, and differences have their rounding.
    double pace = 1, force = 1;
    for (const double share : shares) {
      pace = std::max(pace, length(curve.rate(knots[i] + share * duration)));
      force = std::max(force, length(curve.sample(knots[i] + share * duration).acceleration));
    }
    for (const double share : shares) {
      const double t = knots[i] + share * duration;
      CAPTURE(t);
      const Sample<T> s = curve.sample(t);
      const auto rate = central_difference([&](double u) { return curve.value(u); }, t, h);
      CHECK(length(s.rate - rate) < 1e-6 * pace + 1e-11 / h);
      const Rate<T> bend =
          (8 * (curve.rate(t + h) - curve.rate(t - h)) - (curve.rate(t + 2 * h) - curve.rate(t - 2 * h))) / (12 * h);
      CHECK(length(s.acceleration - bend) < 1e-6 * force + 1e-11 * pace / h);
    }
  }
}

// The integral of the rate over each stretch, by Simpson's rule in a variable that is slow where a rate may be
// infinite.
template <class T>
void check_gain(const Curve<T>& curve) {
  if constexpr (!std::is_same_v<T, Quat>) {
    const auto knots = curve.knots();
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const double duration = knots[i + 1] - knots[i];
      const int parts = 400;
      Rate<T> sum = zero<Rate<T>>();
      double most = 1;
      for (int k = 1; k < 2 * parts; ++k) {
        const double u = k / (2.0 * parts), weight = k % 2 == 0 ? 2 : 4;
        const Rate<T> rate = curve.rate(knots[i] + duration * u * u * (3 - 2 * u));
        sum += (weight / (6.0 * parts) * 6 * u * (1 - u) * duration) * rate;
        most = std::max(most, length(rate) * duration);
      }
      CAPTURE(knots[i]);
      const auto gain = change(curve.value(knots[i + 1], Side::in), curve.value(knots[i]));
      CHECK(length(sum - gain) < 2e-5 * most);
    }
  }
}

template <class T>
void check_keys(const Curve<T>& curve, const std::vector<Key<T>>& keys, bool may_jump) {
  for (const Key<T>& key : keys) {
    CAPTURE(key.time);
    const bool last = key.time == keys.back().time, first = key.time == keys.front().time;
    if (!may_jump || first) CHECK(length(change(curve.value(key.time, Side::in), key.value)) < 1e-14);
    if (!may_jump || last) CHECK(length(change(curve.value(key.time), key.value)) < 1e-14);
  }
  if (may_jump) return;
  // Inside a shape too.
  for (const double knot : curve.knots()) CHECK(length(change(curve.value(knot, Side::in), curve.value(knot))) < 1e-12);
}

template <class T>
void check_quiet(const Curve<T>& curve) {
  const std::size_t before = test::allocations();
  double seen = 0;
  for (int i = -20; i < 60; ++i) seen += length(curve.sample(0.1 * i, i % 2 == 0 ? Side::in : Side::out).rate);
  const std::size_t needed = test::allocations() - before;
  CHECK(needed == 0);
  CHECK(std::isfinite(seen));
}

template <class T>
void check_all(const std::vector<Key<T>>& keys, bool may_jump, bool leaves_at_once = false) {
  const std::size_t before = test::allocations();
  const Curve<T> curve = keyed_curve<T>(std::span<const Key<T>>(keys));
  CHECK(test::allocations() > before);
  check_keys(curve, keys, may_jump);
  check_rates(curve);
  if (!leaves_at_once) check_gain(curve);
  for (const Outside rule :
       {Outside::hold, Outside::linear, Outside::repeat, Outside::repeat_offset, Outside::pingpong})
    check_quiet(curve.with_outside({rule, {}, 1.5}, {rule}));
}

const std::vector<double> key_times = {0, 0.7, 1.5, 1.9, 3};

template <class T>
std::vector<T> values();
template <>
std::vector<double> values() {
  return {1, 3, 2.5, 4, 0.5};
}
template <>
std::vector<Vec2> values() {
  return {{1, 0}, {3, 1}, {2.5, -1}, {4, 2}, {0.5, 2.5}};
}
template <>
std::vector<Vec3> values() {
  return {{1, 0, 2}, {3, 1, 1}, {2.5, -1, 0}, {4, 2, 0.5}, {0.5, 2.5, 1}};
}
template <>
std::vector<Vec4> values() {
  return {{1, 0, 2, 0}, {3, 1, 1, 1}, {2.5, -1, 0, 3}, {4, 2, 0.5, 1}, {0.5, 2.5, 1, -1}};
}
template <>
std::vector<Color> values() {
  return {Color{{0.5, 0.3, 0.4, 1}}, Color{{0.4, 0.4, 0.6, 0.9}}, Color{{0.6, 0.35, 0.45, 1}},
          Color{{0.45, 0.5, 0.5, 0.8}}, Color{{0.5, 0.4, 0.3, 0.9}}};
}
template <>
std::vector<Quat> values() {
  return {exp_map(Vec3(0.2, -0.1, 0.4)), exp_map(Vec3(0.9, 0.6, -0.3)), exp_map(Vec3(0.3, 1.4, 0.8)),
          exp_map(Vec3(-0.6, 0.7, 1)), exp_map(Vec3(0.1, -0.4, 1.2))};
}

template <class T>
std::vector<Key<T>> keys_of_ease(const Ease& ease) {
  std::vector<Key<T>> keys;
  for (std::size_t i = 0; i < key_times.size(); ++i) keys.push_back({key_times[i], values<T>()[i], ease});
  // A period ends as it begins.
  if (ease.name() == "periodic") keys.back().value = keys.front().value;
  return keys;
}

}  // namespace

TEST_CASE_TEMPLATE("every ease meets its keys, has the rates of its values and allocates nothing", T, double, Vec2,
                   Vec3, Vec4, Color, Quat) {
  for (const std::string& form : Ease::names()) {
    const std::string word = with_numbers(form);
    CAPTURE(word);
    const std::optional<Ease> ease = Ease::named(word);
    REQUIRE(ease);
    // Penner's wave has not died out where it comes to rest, and jumps there.
    check_all<T>(keys_of_ease<T>(*ease), jumps(word), word.starts_with("penner-elastic"));
  }
}

TEST_CASE_TEMPLATE("every kind of tangent meets its keys, has the rates of its values and allocates nothing", T, double,
                   Vec2, Vec3, Vec4, Color, Quat) {
  using Way = TangentKind;
  std::vector<Way> kinds = {Way::automatic, Way::flat, Way::given, Way::vector};
  if (!std::is_same_v<T, Quat>)
    kinds.insert(kinds.end(), {Way::aligned, Way::mirrored, Way::plateau, Way::auto_clamped, Way::auto_chord,
                               Way::auto_mix, Way::auto_ease});
  for (const Way kind : kinds)
    for (const double weight : {1.0 / 3, 0.6}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(weight);
      std::vector<Key<T>> keys = keys_of_ease<T>(Ease::smooth_clamped());
      Rate<T> rate = zero<Rate<T>>();
      first_part(rate) = 0.4;
      const bool follows = kind == Way::aligned || kind == Way::mirrored;
      for (Key<T>& key : keys) {
        key.out = Tangent<T>{kind, rate, weight};
        key.in = Tangent<T>{follows ? Way::given : kind, rate, weight};
      }
      check_all<T>(keys, false);
    }
}
