#include <tweenfall/anim/crowd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "curves/counted_allocations.h"
#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr std::size_t header = 16 + 4 + 8 + 8;

std::uint64_t word_at(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
  std::uint64_t word = 0;
  for (std::size_t k = 0; k < size; ++k) word |= static_cast<std::uint64_t>(bytes[at + k]) << (8 * k);
  return word;
}

void set_word(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t word, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) bytes[at + k] = static_cast<std::byte>(word >> (8 * k) & 0xff);
}

// With the length and the checksum that match its contents, as a forger would write them.
std::vector<std::byte> sealed_again(std::vector<std::byte> bytes) {
  const std::span<const std::byte> contents = std::span(bytes).subspan(header);
  std::uint64_t sum = 0xcbf29ce484222325U ^ contents.size();
  for (std::size_t i = 0; i < contents.size(); i += 8) {
    sum = (sum ^ word_at(contents, i, std::min<std::size_t>(8, contents.size() - i))) * 0x100000001b3U;
    sum ^= sum >> 29;
  }
  sum = (sum ^ (sum >> 30)) * 0xbf58476d1ce4e5b9U;
  sum = (sum ^ (sum >> 27)) * 0x94d049bb133111ebU;
  set_word(bytes, 20, contents.size(), 8);
  set_word(bytes, 28, sum ^ (sum >> 31), 8);
  return bytes;
}

CrowdClip small_clip() {
  const auto nodes = random_figure(4, 5);
  Clip clip = random_clip(9, *nodes, 0.8);
  clip.loop = {.mode = LoopMode::repeat_offset, .count = 4};
  return compile(clip, *nodes, {.tolerance = 2e-3});
}

void sample_all(const CrowdClip& clip) {
  if (clip.joints() > 1000) return;
  std::vector<CrowdGroup> pose(clip.groups());
  std::vector<CrowdRates> rates(clip.groups());
  const auto finite = [](const auto& groups) {
    const float* const numbers = reinterpret_cast<const float*>(groups.data());
    return std::all_of(numbers, numbers + groups.size() * sizeof groups[0] / sizeof(float),
                       [](float number) { return std::isfinite(number); });
  };
  for (const double time : {-1.0, 0.0, 0.3, 0.8, 1e9}) {
    clip.sample(clip.clock(0, 1, time), pose, rates);
    REQUIRE(finite(pose));
    REQUIRE(finite(rates));
  }
}

}  // namespace

TEST_CASE("a compiled clip comes back from its bytes with all its bits") {
  const CrowdClip clip = small_clip();
  const std::vector<std::byte> bytes = clip.to_bytes();
  CHECK(clip.byte_count() == bytes.size());
  const CrowdClip again = CrowdClip::from_bytes(bytes);
  CHECK(again.to_bytes() == bytes);
  CHECK(again.joints() == clip.joints());
  CHECK(again.duration() == clip.duration());
  CHECK(again.error() == clip.error());
  CHECK(again.loop().mode == LoopMode::repeat_offset);
  std::vector<CrowdGroup> a(clip.groups()), b(clip.groups());
  std::vector<CrowdRates> a_rates(clip.groups()), b_rates(clip.groups());
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const ClipClock clock = clip.clock(0, 1, random.between(-1, 5));
    clip.sample(clock, a, a_rates);
    again.sample(clock, b, b_rates);
    CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(CrowdGroup)) == 0);
    CHECK(std::memcmp(a_rates.data(), b_rates.data(), a_rates.size() * sizeof(CrowdRates)) == 0);
  }
}

TEST_CASE("compiling the same clip again gives the same bytes") {
  CHECK(small_clip().to_bytes() == small_clip().to_bytes());
}

TEST_CASE("bytes that are cut short, too long or flipped are refused, each and every one") {
  const std::vector<std::byte> bytes = small_clip().to_bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK_THROWS_AS((void)CrowdClip::from_bytes(std::span(bytes).first(size)), std::invalid_argument);
  std::vector<std::byte> changed = bytes;
  changed.push_back(std::byte{0});
  CHECK_THROWS_AS((void)CrowdClip::from_bytes(changed), std::invalid_argument);
  changed = bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const int bit : {0, 3, 7}) {
      changed[i] = bytes[i] ^ static_cast<std::byte>(1 << bit);
      CHECK_THROWS_AS((void)CrowdClip::from_bytes(changed), std::invalid_argument);
      changed[i] = bytes[i];
    }
}

TEST_CASE("forged bytes with a right checksum are refused or can be sampled, and take no more room than they have") {
  const std::vector<std::byte> bytes = small_clip().to_bytes();
  REQUIRE(sealed_again(bytes) == bytes);
  Random random(3);
  int refused = 0;
  const auto attempt = [&](const std::vector<std::byte>& forged) {
    const std::size_t before = bytes_held();
    try {
      const CrowdClip clip = CrowdClip::from_bytes(forged);
      CHECK(bytes_held() - before < 40 * forged.size() + 100000);
      sample_all(clip);
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  };
  for (std::size_t size = header; size < bytes.size(); size += 3) {
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    CHECK_THROWS_AS((void)CrowdClip::from_bytes(sealed_again(cut)), std::invalid_argument);
  }
  // Sizes and places are at the front; they all get numbers that overflow.
  for (std::size_t at = header; at + 8 < std::min<std::size_t>(bytes.size(), header + 900); ++at)
    for (const std::uint64_t word : {0ULL, 1ULL, 0x7fffffffULL, 0x80000000ULL, 0xffffffffULL, 0x20000001ULL}) {
      std::vector<std::byte> forged = bytes;
      set_word(forged, at, word, 4);
      attempt(sealed_again(forged));
    }
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> forged = bytes;
    for (int changes = 1 + static_cast<int>(4 * random.unit()); changes > 0; --changes)
      forged[header + static_cast<std::size_t>(random.unit() * static_cast<double>(bytes.size() - header))] =
          static_cast<std::byte>(random.bits());
    attempt(sealed_again(forged));
  }
  for (int i = 0; i < 500; ++i) {  // some of them are no rotations
    std::vector<std::byte> forged = bytes;
    const double at = random.unit() * static_cast<double>(bytes.size() - header - 100);
    std::fill_n(forged.begin() + header + static_cast<std::ptrdiff_t>(at), 8 * (i % 12), std::byte{0});
    attempt(sealed_again(forged));
  }
  CHECK(refused > 500);
}

TEST_CASE("what is wrong with bytes is said") {
  std::vector<std::byte> bytes = small_clip().to_bytes();
  const auto says = [](const std::vector<std::byte>& bad, const char* what) {
    CHECK_THROWS_WITH_AS((void)CrowdClip::from_bytes(bad), doctest::Contains(what), std::invalid_argument);
  };
  says({}, "fewer than a header has");
  std::vector<std::byte> other = bytes;
  other[0] = std::byte{'T'};
  says(other, "do not begin with \"tweenfall crowd\"");
  other = bytes;
  other[16] = std::byte{9};
  says(other, "version 9");
  other = bytes;
  other.pop_back();
  says(other, "there should be");
  other = bytes;
  other.back() ^= std::byte{1};
  says(other, "damaged");
}

TEST_CASE("a compiled clip that was moved from is what it was") {
  Clip clip;
  clip.duration = 3;
  CrowdClip compiled = compile(clip, Hierarchy({{"bone"}}));
  const CrowdClip taken = std::move(compiled);
  CHECK(compiled.duration() == 3);
  CHECK(taken.to_bytes() == compiled.to_bytes());
}
