#include "fbx/records/source.h"

#include <tweenfall/importers/model.h>

#include <algorithm>

namespace tweenfall::fbx {

namespace {

std::size_t line_of(std::string_view bytes, std::size_t at) {
  return 1 + static_cast<std::size_t>(std::ranges::count(bytes.substr(0, at), '\n'));
}

}  // namespace

std::string Source::place(std::size_t at) const {
  return text_ ? "line " + std::to_string(line_of(bytes_, at)) : "byte " + std::to_string(at);
}

void Source::fail(std::size_t at, const std::string& what) const {
  at = std::min(at, bytes_.size());
  if (!text_) throw ModelError(file_ + ": byte " + std::to_string(at) + ": error: " + what);
  const std::size_t before = at == 0 ? std::string_view::npos : bytes_.rfind('\n', at - 1);
  const std::size_t column = at - (before == std::string_view::npos ? 0 : before + 1) + 1;
  throw ModelError(file_ + ":" + std::to_string(line_of(bytes_, at)) + ":" + std::to_string(column) +
                   ": error: " + what);
}

}  // namespace tweenfall::fbx
