#include "saving/envelope.h"

#include <algorithm>
#include <string>

#include "saving/bytes.h"
#include "saving/word_hash.h"
#include "state/checks.h"

namespace tweenfall::saving {

namespace {

std::string signature_of(const Envelope& envelope) {
  return std::string("tweenfall ") + envelope.kind + "\n";
}

}  // namespace

std::uint64_t checksum(std::span<const std::byte> bytes) {
  WordHash hash;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(8, bytes.size() - i); ++k)
      word |= static_cast<std::uint64_t>(bytes[i + k]) << (8 * k);
    hash.add(word);
  }
  return hash.value();
}

std::vector<std::byte> sealed(const Envelope& envelope, std::span<const std::byte> contents) {
  ByteWriter saved;
  for (const char c : signature_of(envelope)) saved.number(c);
  saved.number(envelope.version);
  saved.number(static_cast<std::uint64_t>(contents.size()));
  saved.number(checksum(contents));
  saved.bytes.insert(saved.bytes.end(), contents.begin(), contents.end());
  return std::move(saved.bytes);
}

std::span<const std::byte> opened(const Envelope& envelope, std::span<const std::byte> saved) {
  const std::string signature = signature_of(envelope), kind = envelope.kind;
  const std::size_t header_size = signature.size() + 4 + 8 + 8;
  state::require(saved.size() >= header_size,
                 "these " + std::to_string(saved.size()) + " bytes are too few for a saved " + kind);
  ByteReader header(saved, envelope.kind);
  for (const char expected : signature) {
    char found = 0;
    header.number(found);
    state::require(found == expected,
                   "these bytes are no saved " + kind + ": they do not begin with \"tweenfall " + kind + "\"");
  }
  std::uint32_t its_version = 0;
  std::uint64_t size = 0, sum = 0;
  header.number(its_version);
  header.number(size);
  header.number(sum);
  state::require(its_version == envelope.version, "this saved " + kind + " is of version " +
                                                      std::to_string(its_version) + "; only version " +
                                                      std::to_string(envelope.version) + " can be read");
  const std::span<const std::byte> contents = saved.subspan(header_size);
  state::require(contents.size() == size, "a saved " + kind + " should have " + std::to_string(size) +
                                              " bytes after its header, but has " + std::to_string(contents.size()));
  state::require(checksum(contents) == sum,
                 "a saved " + kind + " was damaged: its checksum is not that of its contents");
  return contents;
}

}  // namespace tweenfall::saving
