#include "gltf/read/accessors.h"

#include "gltf/format.h"
#include "gltf/write/buffer_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tweenfall::gltf {

namespace {

std::size_t size_of(std::size_t component) {
  switch (component) {
    case byte_component:
    case unsigned_byte_component:
      return 1;
    case short_component:
    case unsigned_short_component:
      return 2;
    case unsigned_int_component:
    case float_component:
      return 4;
    default:
      return 0;
  }
}

template <class Number>
double load(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

/// Source: glTF 2.0 specification, section 3.11, the equations of normalized integers.
double component_value(const char* bytes, int component, bool normalized) {
  switch (component) {
    case byte_component: {
      const double c = load<std::int8_t>(bytes);
      return normalized ? std::max(c / 127.0, -1.0) : c;
    }
    case unsigned_byte_component:
      return load<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case short_component: {
      const double c = load<std::int16_t>(bytes);
      return normalized ? std::max(c / 32767.0, -1.0) : c;
    }
    case unsigned_short_component:
      return load<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case unsigned_int_component:
      return load<std::uint32_t>(bytes);
    default:
      return load<float>(bytes);
  }
}

std::string joined(std::initializer_list<const char*> words) {
  std::string text;
  for (const char* word : words) text += (text.empty() ? "" : " or ") + std::string(word);
  return text;
}

}  // namespace

/// Elements in a buffer, all of them inside it.
struct Accessors::Source {
  const char* first = nullptr;
  std::size_t stride = 0;
};

Accessors::Accessors(const Container& container, models::ModelProblems& problems)
    : container_(container),
      problems_(problems),
      root_(container.document.root(), "", problems),
      count_(root_.list("accessors").size()),
      // Accessors may share bytes, so a small file could ask for any amount of memory.
      budget_((std::size_t{1} << 22) + 64 * container.file_size) {}

bool Accessors::afford(const Fields& accessor, std::size_t numbers) {
  if (numbers <= budget_) {
    budget_ -= numbers;
    return true;
  }
  problems_.add(accessor.place_of("count"),
                "asks for more numbers than a file of " + std::to_string(container_.file_size) + " bytes may hold");
  return false;
}

std::optional<Accessors::Source> Accessors::source(const Fields& fields, const char* offset_name, std::size_t count,
                                                   std::size_t element_size) const {
  const auto view_index = fields.required_index("bufferView", root_.list("bufferViews").size());
  if (!view_index) return std::nullopt;
  const Fields view = root_.at("bufferViews", *view_index);
  const auto buffer_index = view.required_index("buffer", container_.buffers.size());
  if (!buffer_index) return std::nullopt;
  const std::string& buffer = container_.buffers[*buffer_index];
  const std::size_t offset = view.whole("byteOffset").value_or(0), length = view.whole("byteLength").value_or(0);
  if (offset > buffer.size() || length > buffer.size() - offset) {
    problems_.add(view.place(), "lies at bytes " + std::to_string(offset) + " to " + std::to_string(offset) + " + " +
                                    std::to_string(length) + " of a buffer of " + std::to_string(buffer.size()));
    return std::nullopt;
  }
  const std::size_t start = fields.whole(offset_name).value_or(0);
  const std::size_t stride = std::max(view.whole("byteStride").value_or(element_size), std::size_t{1});
  const bool fits = stride <= 0xFFFF && stride >= element_size && start <= length && element_size <= length - start &&
                    count - 1 <= (length - start - element_size) / stride;
  if (!fits) {
    problems_.add(fields.place(), std::to_string(count) + " elements of " + std::to_string(element_size) +
                                      " bytes do not fit in bufferView " + std::to_string(*view_index) + " of " +
                                      std::to_string(length) + " bytes");
    return std::nullopt;
  }
  return Source{buffer.data() + offset + start, stride};
}

bool Accessors::decode_sparse(const Fields& accessor, int component, bool normalized, Decoded& decoded) {
  const Fields sparse = accessor.inside("sparse");
  const Fields indices = sparse.inside("indices"), values = sparse.inside("values");
  const std::size_t count = sparse.whole("count").value_or(0);
  const std::size_t index_component = indices.whole("componentType").value_or(0);
  const std::size_t size = size_of(index_component), part_size = size_of(static_cast<std::size_t>(component));
  if (count == 0 || count > decoded.count || size == 0 || index_component == float_component) {
    problems_.add(sparse.place(), "needs a count from 1 to the accessor's and whole numbers as indices");
    return false;
  }
  const auto index_source = source(indices, "byteOffset", count, size);
  const auto value_source = source(values, "byteOffset", count, part_size * decoded.parts);
  if (!index_source || !value_source) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const char* where = index_source->first + i * index_source->stride;
    const double index = component_value(where, static_cast<int>(index_component), false);
    if (!(index >= 0 && index < static_cast<double>(decoded.count))) {
      problems_.add(indices.place(), "index " + std::to_string(static_cast<long long>(index)) +
                                         " points past the accessor's " + std::to_string(decoded.count) + " elements");
      return false;
    }
    const char* value = value_source->first + i * value_source->stride;
    for (std::size_t part = 0; part < decoded.parts; ++part)
      decoded.numbers[static_cast<std::size_t>(index) * decoded.parts + part] =
          component_value(value + part * part_size, component, normalized);
  }
  return true;
}

std::optional<Decoded> Accessors::read(std::size_t accessor, const std::string& user,
                                       std::initializer_list<const char*> types, Wanted wanted) {
  const Fields fields = root_.at("accessors", accessor);
  const std::string type = fields.text("type");
  const std::size_t component = fields.whole("componentType").value_or(0), part_size = size_of(component);
  const bool normalized = fields.flag("normalized");
  if (part_size == 0) {
    problems_.add(fields.place_of("componentType"), "must be 5120, 5121, 5122, 5123, 5125 or 5126");
    return std::nullopt;
  }
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    problems_.add(user, "accessor " + std::to_string(accessor) + " must hold " + joined(types) + ", not " +
                            (type.empty() ? "nothing" : type.substr(0, 20)));
    return std::nullopt;
  }
  const bool real = component == float_component || normalized;
  const bool unsigned_whole = component == unsigned_byte_component || component == unsigned_short_component ||
                              component == unsigned_int_component;
  const bool reals = wanted == Wanted::reals || wanted == Wanted::spare;
  if ((reals && !real) || (wanted == Wanted::indices && (!unsigned_whole || normalized))) {
    problems_.add(user, "accessor " + std::to_string(accessor) + " must hold " +
                            (reals ? "floats or normalized integers" : "unsigned integers") + ", not component type " +
                            std::to_string(component));
    return std::nullopt;
  }
  Decoded decoded;
  decoded.parts = parts_of(type);
  decoded.count = fields.whole("count").value_or(0);
  if (decoded.count == 0) {
    problems_.add(fields.place_of("count"), "must be at least 1");
    return std::nullopt;
  }
  std::optional<Source> from;
  if (fields.has("bufferView")) {
    from = source(fields, "byteOffset", decoded.count, part_size * decoded.parts);
    if (!from) return std::nullopt;
  }
  // So that no product with the size of an element overflows.
  constexpr auto most = static_cast<std::size_t>(
      std::min<std::uint64_t>(std::uint64_t{1} << 40, std::numeric_limits<std::size_t>::max() / 64));
  if (decoded.count > most || !afford(fields, decoded.count * decoded.parts)) {
    if (decoded.count > most) problems_.add(fields.place_of("count"), "is beyond any file");
    return std::nullopt;
  }
  decoded.numbers.assign(decoded.count * decoded.parts, 0.0);
  if (from)
    for (std::size_t i = 0; i < decoded.count; ++i)
      for (std::size_t part = 0; part < decoded.parts; ++part)
        decoded.numbers[i * decoded.parts + part] =
            component_value(from->first + i * from->stride + part * part_size, static_cast<int>(component), normalized);
  if (fields.has("sparse") && !decode_sparse(fields, static_cast<int>(component), normalized, decoded))
    return std::nullopt;
  for (std::size_t i = 0; i < decoded.numbers.size(); ++i)
    if (!std::isfinite(decoded.numbers[i])) {
      const std::string fault = "element " + std::to_string(i / decoded.parts) + " is not a finite number";
      if (wanted == Wanted::spare)
        problems_.repair(user, fault + "; all of them were left out");
      else
        problems_.add(fields.place(), fault);
      return std::nullopt;
    }
  return decoded;
}

}  // namespace tweenfall::gltf
