#include "plot/svg_writer.h"

#include <tweenfall/importers/number_text.h>

namespace tweenfall {

namespace {

void append_escaped(std::string& out, std::string_view text) {
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (static_cast<unsigned char>(c) < 0x20 && c != '\n') {
      out += ' ';
    } else {
      out += c;
    }
  }
}

}  // namespace

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
    append_escaped(out_, value);
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
  append_escaped(out_, content);
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

}  // namespace tweenfall
