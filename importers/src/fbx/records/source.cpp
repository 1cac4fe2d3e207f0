#include "fbx/records/source.h"

#include <tweenfall/importers/model.h>

#include <algorithm>

namespace tweenfall::fbx {

std::size_t Source::line_of(std::size_t at) const {
  const std::size_t first = std::min(at, counted_), behind = std::max(at, counted_);
  const auto between = static_cast<std::size_t>(std::ranges::count(bytes_.substr(first, behind - first), '\n'));
  lines_ = at < counted_ ? lines_ - between : lines_ + between;
  counted_ = at;
  return lines_ + 1;
}

std::string Source::place(std::size_t at) const {
  return text_ ? "line " + std::to_string(line_of(at)) : "byte " + std::to_string(at);
}

void Source::fail(std::size_t at, const std::string& what) const {
  at = std::min(at, bytes_.size());
  if (!text_) throw ModelError(file_ + ": byte " + std::to_string(at) + ": error: " + what);
  const std::size_t before = at == 0 ? std::string_view::npos : bytes_.rfind('\n', at - 1);
  const std::size_t column = at - (before == std::string_view::npos ? 0 : before + 1) + 1;
  throw ModelError(file_ + ":" + std::to_string(line_of(at)) + ":" + std::to_string(column) + ": error: " + what);
}

}  // namespace tweenfall::fbx
