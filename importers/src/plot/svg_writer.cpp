#include "plot/svg_writer.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/shown_text.h>

namespace tweenfall::plotting {

SvgWriter::SvgWriter(double width, double height) {
  open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
               {"width", px(width)},
               {"height", px(height)},
               {"viewBox", "0 0 " + px(width) + " " + px(height)},
               {"font-family", "system-ui, DejaVu Sans, sans-serif"},
               {"font-size", "12"}});
}

void SvgWriter::begin(std::string_view element, Attributes attributes) {
  out_.append(2 * open_.size(), ' ');
  (out_ += '<') += element;
  for (const auto& [name, value] : attributes) {
    ((out_ += ' ') += name) += "=\"";
    out_ += markup_text(value);
    out_ += '"';
  }
}

void SvgWriter::open(std::string_view element, Attributes attributes) {
  begin(element, attributes);
  out_ += ">\n";
  open_.emplace_back(element);
}

void SvgWriter::close() {
  const std::string element = open_.back();
  open_.pop_back();
  out_.append(2 * open_.size(), ' ');
  ((out_ += "</") += element) += ">\n";
}

void SvgWriter::leaf(std::string_view element, Attributes attributes) {
  begin(element, attributes);
  out_ += "/>\n";
}

void SvgWriter::text(std::string_view element, Attributes attributes, std::string_view content) {
  begin(element, attributes);
  out_ += '>';
  out_ += markup_text(content);
  ((out_ += "</") += element) += ">\n";
}

void SvgWriter::comment(std::string_view content) {
  out_.append(2 * open_.size(), ' ');
  ((out_ += "<!-- ") += content) += " -->\n";
}

std::string SvgWriter::finish() {
  while (!open_.empty()) close();
  return std::move(out_);
}

std::string px(double value) {
  return short_text(value, 2);
}

std::string px(double x, double y) {
  return px(x) + "," + px(y);
}

}  // namespace tweenfall::plotting
