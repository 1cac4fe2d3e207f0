#include "gltf/read/container.h"

#include "gltf/format.h"
#include "model/model_bytes.h"

#include <array>
#include <charconv>
#include <optional>

namespace tweenfall::gltf {

namespace {

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return word;
}

struct Chunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Some call the text of a .gltf file .glb.
bool begins_as_text(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first == std::string_view::npos || bytes[first] == '{';
}

std::optional<Chunks> take_chunks(std::string_view bytes, models::ModelProblems& problems) {
  if (bytes.size() < 20) {
    problems.add("", "ends after " + std::to_string(bytes.size()) + " bytes, before its first chunk");
    return std::nullopt;
  }
  if (word_at(bytes, 4) != 2) {
    problems.add("", "is binary glTF of version " + std::to_string(word_at(bytes, 4)) + "; version 2 can be read");
    return std::nullopt;
  }
  const std::uint32_t length = word_at(bytes, 8);
  if (length > bytes.size()) {
    problems.add("", "says it has " + std::to_string(length) + " bytes but ends after " + std::to_string(bytes.size()));
    return std::nullopt;
  }
  bytes = bytes.substr(0, length);
  Chunks chunks;
  for (std::size_t at = 12, number = 0; at + 8 <= bytes.size(); ++number) {
    const std::size_t size = word_at(bytes, at), kind = word_at(bytes, at + 4);
    if (size > bytes.size() - at - 8) {
      problems.add("", "chunk " + std::to_string(number) + " says it has " + std::to_string(size) + " bytes but only " +
                           std::to_string(bytes.size() - at - 8) + " are left");
      return std::nullopt;
    }
    const std::string_view content = bytes.substr(at + 8, size);
    if (number == 0 && kind != json_chunk) {
      problems.add("", "the first chunk must be the JSON");
      return std::nullopt;
    }
    if (number == 0)
      chunks.json = content;
    else if (kind == bin_chunk && !chunks.binary)
      chunks.binary = content;
    at += 8 + size;
  }
  return chunks;
}

std::optional<std::string> from_base64(std::string_view text) {
  static const std::array<signed char, 256> values = [] {
    std::array<signed char, 256> table{};
    table.fill(-1);
    const std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < letters.size(); ++i)
      table[static_cast<unsigned char>(letters[i])] = static_cast<signed char>(i);
    return table;
  }();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string out;
  out.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : text) {
    const int value = values[static_cast<unsigned char>(letter)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<char>(bits >> count & 0xFF));
  }
  return out;
}

std::string without_percent_signs(std::string_view uri) {
  const auto hex = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0;
    out.push_back(coded ? static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2])) : uri[i]);
    if (coded) i += 2;
  }
  return out;
}

std::optional<std::string> buffer_bytes(const Fields& buffer, const std::filesystem::path& file,
                                        std::optional<std::string_view> binary, bool first) {
  models::ModelProblems& problems = buffer.problems();
  if (!buffer.has("uri")) {
    if (first && binary) return std::string(*binary);
    problems.add(buffer.place(), "has no \"uri\", and there is no binary chunk for it");
    return std::nullopt;
  }
  const std::string uri = buffer.text("uri");
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
      problems.add(buffer.place_of("uri"), "must carry its data as \"data:...;base64,...\"");
      return std::nullopt;
    }
    auto bytes = from_base64(std::string_view(uri).substr(comma + 1));
    if (!bytes) problems.add(buffer.place_of("uri"), "holds a character that base64 does not have");
    return bytes;
  }
  const std::string name = without_percent_signs(uri);
  if (name.find('\0') != std::string::npos) {
    problems.add(buffer.place_of("uri"), "\"" + uri.substr(0, 80) + "\" holds a zero byte, which no name has");
    return std::nullopt;
  }
  // A hostile file must not be able to read the rest of the disk.
  const std::filesystem::path path = name;
  if (uri.find("://") != std::string::npos || models::leads_out_of(file.parent_path(), path)) {
    problems.add(buffer.place_of("uri"), "\"" + uri.substr(0, 80) + "\" must name a file in the model's own folder");
    return std::nullopt;
  }
  std::string reason;
  auto bytes = models::model_bytes(file.parent_path() / path, reason);
  if (!bytes) problems.add(buffer.place_of("uri"), "file \"" + path.string() + "\": " + reason);
  return bytes;
}

void read_buffers(Container& container, const std::filesystem::path& file, std::optional<std::string_view> binary,
                  models::ModelProblems& problems) {
  const Fields root(container.document.root(), "", problems);
  const std::size_t count = root.list("buffers").size();
  container.buffers.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Fields buffer = root.at("buffers", i);
    auto bytes = buffer_bytes(buffer, file, binary, i == 0);
    if (!bytes) continue;
    const std::size_t length = buffer.whole("byteLength").value_or(bytes->size());
    if (length > bytes->size()) {
      problems.add(buffer.place_of("byteLength"),
                   "says " + std::to_string(length) + " bytes but there are " + std::to_string(bytes->size()));
      continue;
    }
    bytes->resize(length);
    container.file_size += length;
    container.buffers[i] = std::move(*bytes);
  }
}

/// Extensions that do not affect what is read here, or that are supported.
bool can_do_without(const std::string& extension) {
  for (const char* prefix : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_mesh_quantization"})
    if (extension.starts_with(prefix)) return true;
  return false;
}

void check_header(const Container& container, models::ModelProblems& problems) {
  const Fields root(container.document.root(), "", problems);
  const Fields asset = root.inside("asset");
  const std::string version = asset.text("version");
  if (!version.starts_with("2."))
    problems.add("/asset/version", version.empty() ? "is missing; glTF 2.0 can be read"
                                                   : "is \"" + version.substr(0, 20) + "\"; glTF 2.0 can be read");
  for (const auto& extension : root.list("extensionsRequired"))
    if (extension.is(json::Value::Kind::text) && !can_do_without(std::string(extension.text())))
      problems.add("/extensionsRequired", "the file needs " + std::string(extension.text()) + ", which cannot be read");
}

void tell(const json::Fault& fault, const Container& container, models::ModelProblems& problems) {
  if (!container.has_lines)
    problems.add("", "is not valid JSON: at byte " + std::to_string(fault.offset) + " of it, " + fault.message);
  else
    problems.add(json::place_in(container.document.text(), fault.offset), "is not valid JSON: " + fault.message);
}

}  // namespace

std::optional<json::TextPlace> place_in(const Container& container, std::string_view place) {
  if (!container.has_lines || !place.starts_with('/')) return std::nullopt;
  json::Value at = container.document.root();
  while (!place.empty()) {
    place.remove_prefix(1);
    const std::string_view name = place.substr(0, place.find('/'));
    place.remove_prefix(name.size());
    json::Value inside = at.find(name);
    std::size_t position = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), position);
    if (at.is(json::Value::Kind::list) && error == std::errc() && position < at.items().size())
      inside = at.items()[position];
    if (!inside) break;
    at = inside;
  }
  return json::place_in(container.document.text(), at.offset());
}

Container open_container(std::string_view bytes, const std::filesystem::path& file, models::ModelProblems& problems) {
  Container container;
  container.file_size = bytes.size();
  Chunks chunks{bytes, std::nullopt};
  if (bytes.size() >= 4 && word_at(bytes, 0) == glb_magic) {
    const auto taken = take_chunks(bytes, problems);
    if (!taken) return container;
    chunks = *taken;
    container.has_lines = false;
  } else if (file.extension() == ".glb" && !begins_as_text(bytes)) {
    problems.add("", "is no binary glTF, which begins with the letters \"glTF\"");
    return container;
  }
  // Some writers fill the chunk up with zeros instead of spaces.
  chunks.json = chunks.json.substr(0, chunks.json.find_last_not_of('\0') + 1);
  if (chunks.json.empty()) {
    problems.add("", "is empty");
    return container;
  }
  // Embedded buffers make the text as large as a model may be.
  const json::Rules rules{.comments = false, .names_twice = true};
  std::vector<json::Fault> faults;
  container.document = json::Tree::parse(std::string(chunks.json), faults, rules);
  for (const json::Fault& fault : faults) tell(fault, container, problems);
  if (!faults.empty()) return container;
  // A root that is not an object, or too large a one, reads as empty; all that is missing in it would be reported too.
  const Fields root(container.document.root(), "", problems);
  if (problems.any()) return container;
  check_header(container, problems);
  read_buffers(container, file, chunks.binary, problems);
  return container;
}

}  // namespace tweenfall::gltf
