#include "report/table.h"

#include <tweenfall/importers/shown_text.h>

#include <algorithm>

namespace tweenfall::cli {

namespace {

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

Table::Table(std::string title, std::vector<std::string> head) : title_(std::move(title)), head_(std::move(head)) {
  for (std::string& name : head_) {
    right_.push_back(name.starts_with('>'));
    if (right_.back()) name.erase(0, 1);
  }
}

void Table::row(std::vector<std::string> cells) {
  cells.resize(head_.size());
  for (std::string& cell : cells) cell = terminal_text(cell);
  rows_.push_back(std::move(cells));
}

void Table::note(std::string text) {
  notes_.push_back(std::move(text));
}

std::string Table::text(bool styled) const {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < head_.size(); ++i) {
    widths.push_back(width(head_[i]));
    for (const auto& cells : rows_) widths[i] = std::max(widths[i], width(cells[i]));
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string out = " ";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string gap(widths[i] - width(cells[i]), ' ');
      out += " " + (right_[i] ? gap + cells[i] : cells[i] + gap) + " ";
    }
    while (out.ends_with(' ')) out.pop_back();
    return out;
  };
  const std::string bold = styled ? "\033[1m" : "", faint = styled ? "\033[2m" : "", plain = styled ? "\033[0m" : "";
  std::string out;
  if (!title_.empty()) out += bold + terminal_text(title_) + plain + "\n";
  if (!rows_.empty()) out += faint + line(head_) + plain + "\n";
  for (const auto& cells : rows_) out += line(cells) + "\n";
  for (const std::string& text : notes_) out += "  " + terminal_text(text) + "\n";
  return out;
}

}  // namespace tweenfall::cli
