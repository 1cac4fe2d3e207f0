#pragma once

// SVG as text: elements that open and close, attributes in the order given, two spaces per level. The same calls give
// the same text.

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tweenfall::plotting {

class SvgWriter {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string>>;

  SvgWriter(double width, double height);  ///< px

  void open(std::string_view element, Attributes attributes = {});
  void close();
  void leaf(std::string_view element, Attributes attributes);
  /// An element that contains only text.
  void text(std::string_view element, Attributes attributes, std::string_view content);
  void comment(std::string_view content);

  /// The whole document; everything opened must have been closed.
  [[nodiscard]] std::string finish();

 private:
  void begin(std::string_view element, Attributes attributes);

  std::string out_;
  std::vector<std::string> open_;
};

/// A length or coordinate with at most two decimals.
[[nodiscard]] std::string px(double value);

/// "x,y"
[[nodiscard]] std::string px(double x, double y);

}  // namespace tweenfall::plotting
