#include "fbx/records/packed_array.h"

#include <zlib.h>

#include <algorithm>

namespace tweenfall::fbx {

namespace {

/// A byte of a deflated stream expands to at most this many. Source: zlib, "Technical details", maximum compression.
constexpr std::size_t most_per_byte = 1032;
/// More than any real mesh has.
constexpr std::size_t most_bytes = std::size_t{1} << 31;

class Inflater {
 public:
  Inflater() { ready_ = inflateInit(&stream_) == Z_OK; }
  ~Inflater() {
    if (ready_) inflateEnd(&stream_);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Appends to `out` until it holds `wanted` bytes or the stream ends; false when the stream is broken.
  bool fill(std::string_view from, std::size_t wanted, std::string& out) {
    if (!ready_) return false;
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from.data()));
    stream_.avail_in = static_cast<uInt>(from.size());
    int state = Z_OK;
    while (out.size() < wanted && state == Z_OK) {
      char part[1 << 15];
      const std::size_t room = std::min(sizeof part, wanted - out.size());
      stream_.next_out = reinterpret_cast<Bytef*>(part);
      stream_.avail_out = static_cast<uInt>(room);
      state = inflate(&stream_, Z_NO_FLUSH);
      const std::size_t made = room - stream_.avail_out;
      out.append(part, made);
      if (made == 0 && stream_.avail_in == 0) break;
    }
    return state == Z_OK || state == Z_STREAM_END || state == Z_BUF_ERROR;
  }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

std::string elements(std::size_t count) {
  return "an array of " + std::to_string(count) + " elements";
}

}  // namespace

std::string unpacked(const PackedArray& array, const Source& source) {
  const std::size_t stored = array.stored.size();
  if (array.count > most_bytes / array.size)
    source.fail(array.at, elements(array.count) + " would be " +
                              std::to_string(array.count / (std::size_t{1} << 30) * array.size) +
                              " GB; at most 2 GB can be read");
  const std::size_t wanted = array.count * array.size;
  if (!array.packed) {
    if (stored != wanted)
      source.fail(array.at, elements(array.count) + " needs " + std::to_string(wanted) + " bytes; there are " +
                                std::to_string(stored));
    return std::string(array.stored);
  }
  if (wanted > 0 && stored < wanted / most_per_byte)
    source.fail(array.at, elements(array.count) + ", " + std::to_string(wanted) + " bytes, cannot be packed into " +
                              std::to_string(stored));
  std::string out;
  if (!Inflater().fill(array.stored, wanted, out)) source.fail(array.at, "the packed array is damaged");
  if (out.size() < wanted)
    source.fail(array.at, elements(array.count) + " needs " + std::to_string(wanted) + " bytes; unpacked there are " +
                              std::to_string(out.size()));
  return out;
}

}  // namespace tweenfall::fbx
