#include "graph_picture/graph_boxes.h"

#include "plot/label_rows.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::plotting {

namespace {

constexpr const char* box_ink = "#24292f";
constexpr const char* box_pale = "#57606a";
constexpr const char* arrow_line = "#8c959f";

/// How much wider a bold name is than usual text, and the small words below it; and what a box has beside them, px.
constexpr double bolder = 1.3, smaller = 0.9, beside_words = 12;

constexpr int points_on_arrow = 80;

}  // namespace

Vec2 Rectangle::border_toward(const Vec2& point) const {
  const Vec2 middle = center(), way = point - middle;
  const double x = std::abs(way.x()) * (bottom - top), y = std::abs(way.y()) * (right - left);
  if (x == 0 && y == 0) return middle;
  const double part = x > y ? (right - left) / 2 / std::abs(way.x()) : (bottom - top) / 2 / std::abs(way.y());
  return middle + std::min(part, 1.0) * way;
}

Rectangle around(const Vec2& center, double width, double height) {
  return {center.x() - width / 2, center.y() - height / 2, center.x() + width / 2, center.y() + height / 2};
}

double box_width_of(const std::string& name, const std::string& words) {
  return std::ceil(std::max(bolder * text_width(name), smaller * text_width(words)) + 0.5) + beside_words;
}

void draw_box(SvgWriter& svg, const Rectangle& box, const std::string& name, const std::string& words,
              const BoxStyle& style) {
  const double width = box.right - box.left, x = (box.left + box.right) / 2, y = (box.top + box.bottom) / 2;
  svg.open("g");
  svg.text("title", {}, words.empty() ? name : name + ": " + words);
  svg.leaf("rect", {{"x", px(box.left)},
                    {"y", px(box.top)},
                    {"width", px(width)},
                    {"height", px(box.bottom - box.top)},
                    {"rx", px(style.round)},
                    {"fill", style.fill},
                    {"stroke", style.stroke},
                    {"stroke-width", style.strong ? "2.5" : "1.2"}});
  svg.text("text",
           {{"x", px(x)},
            {"y", px(words.empty() ? y + 4 : y - 2)},
            {"text-anchor", "middle"},
            {"font-weight", "600"},
            {"fill", box_ink}},
           shortened(name, (width - beside_words) / bolder));
  if (!words.empty())
    svg.text("text",
             {{"x", px(x)}, {"y", px(y + 13)}, {"text-anchor", "middle"}, {"font-size", "10.5"}, {"fill", box_pale}},
             shortened(words, (width - beside_words) / smaller));
  svg.close();
}

void draw_arrow(SvgWriter& svg, const Arrow& arrow) {
  const auto& [from, control, to] = arrow;
  Vec2 way = to - control;
  way /= std::max(way.norm(), 1e-9);
  const Vec2 across(-way.y(), way.x()), foot = to - 9 * way;
  svg.leaf("path",
           {{"d", "M" + px(from.x(), from.y()) + " Q" + px(control.x(), control.y()) + " " + px(foot.x(), foot.y())},
            {"fill", "none"},
            {"stroke", arrow_line},
            {"stroke-width", "1.4"}});
  const Vec2 one = foot + 4 * across, other = foot - 4 * across;
  svg.leaf("polygon", {{"points", px(to.x(), to.y()) + " " + px(one.x(), one.y()) + " " + px(other.x(), other.y())},
                       {"fill", arrow_line}});
}

Vec2 Arrow::at(double t) const {
  return (1 - t) * (1 - t) * from + 2 * t * (1 - t) * control + t * t * to;
}

Labels::Labels(std::vector<Rectangle> taken, std::vector<Arrow> arrows, double left, double right)
    : taken_(std::move(taken)), arrows_(std::move(arrows)), left_(left), right_(right) {
  for (const Arrow& arrow : arrows_) {
    std::vector<Vec2>& points = points_.emplace_back();
    for (int i = 0; i <= points_on_arrow; ++i) points.push_back(arrow.at(static_cast<double>(i) / points_on_arrow));
  }
}

std::size_t Labels::crossed(const Rectangle& place, std::size_t own) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (i != own)
      count += std::ranges::any_of(points_[i], [&](const Vec2& p) { return place.overlaps(around(p, 0, 0)); }) ? 1 : 0;
  return count;
}

void Labels::draw(SvgWriter& svg, std::size_t arrow, const std::string& first, const std::string& second) {
  constexpr double widest = 230;
  const std::string one = shortened(first, widest), two = shortened(second, widest);
  const double width = 1.1 * std::max(text_width(one), text_width(two)) + 8, height = 30;
  const Arrow& own = arrows_[arrow];
  const auto beside = [&](Vec2 center) {
    center.x() = std::max(left_ + width / 2, std::min(center.x(), right_ - width / 2));
    return around(center, width, height);
  };
  Rectangle best = beside(own.at(0.5));
  std::size_t fewest = arrows_.size();
  for (const double shift : {0.0, -16.0, 16.0, -32.0, 32.0, -48.0, 48.0})
    for (const double t : {0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65, 0.3, 0.7, 0.25, 0.75, 0.2, 0.8, 0.15, 0.85}) {
      const Rectangle place = beside(own.at(t) + Vec2(0, shift));
      if (fewest == 0 || (shift != 0 && fewest < arrows_.size())) break;  // better crossed than beside its own
      if (std::ranges::any_of(taken_, [&](const Rectangle& other) { return place.overlaps(other); })) continue;
      const std::size_t others = crossed(place, arrow);
      if (others >= fewest) continue;
      fewest = others;
      best = place;
    }
  taken_.push_back(best);
  const Vec2 middle = best.center();
  svg.open("g");
  svg.text("title", {}, first + "; " + second);
  svg.leaf("rect", {{"x", px(best.left)},
                    {"y", px(best.top)},
                    {"width", px(width)},
                    {"height", px(height)},
                    {"rx", "4"},
                    {"fill", "#ffffff"},
                    {"fill-opacity", "0.88"}});
  svg.text("text",
           {{"x", px(middle.x())},
            {"y", px(middle.y() - 2)},
            {"text-anchor", "middle"},
            {"font-size", "11"},
            {"fill", box_ink}},
           one);
  svg.text("text",
           {{"x", px(middle.x())},
            {"y", px(middle.y() + 11)},
            {"text-anchor", "middle"},
            {"font-size", "10"},
            {"fill", box_pale}},
           two);
  svg.close();
}

}  // namespace tweenfall::plotting
