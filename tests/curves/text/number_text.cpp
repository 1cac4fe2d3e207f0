// Numbers as text and back.

#include "support.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/number_text.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <locale>
#include <stdexcept>

using namespace tweenfall;

TEST_CASE("the text of a number reads back to the same bits") {
  const auto same_bits = [](double number) {
    const auto back = parse_number(number_text(number));
    REQUIRE(back.has_value());
    CHECK(std::bit_cast<std::uint64_t>(*back) == std::bit_cast<std::uint64_t>(number));
  };
  for (const double number : {0.0, -0.0, 0.1, 1.0 / 3, 5e-324, std::numeric_limits<double>::max(), -123456789.125})
    same_bits(number);
  std::uint64_t bits = 88172645463325252;  // Marsaglia's xorshift, 2003
  for (int i = 0; i < 2000; ++i) {
    bits ^= bits << 13;
    bits ^= bits >> 7;
    bits ^= bits << 17;
    const double number = std::bit_cast<double>(bits);
    if (std::isfinite(number)) same_bits(number);
  }
}

TEST_CASE("the text of a number is the shortest") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(0.1 + 0.2) == "0.30000000000000004");
  CHECK(number_text(-0.0) == "-0.0");
  CHECK(number_text(1e300) == "1e+300");
}

TEST_CASE("numbers for pictures have fixed decimals without what says nothing") {
  CHECK(short_text(1.25, 1) == "1.2");
  CHECK(short_text(2, 3) == "2");
  CHECK(short_text(100, 0) == "100");
  CHECK(short_text(-0.004, 2) == "0");
  CHECK(short_text(std::numeric_limits<double>::max(), 2).size() == 309);
}

TEST_CASE("numbers for people have five digits at most") {
  CHECK(brief_text(3.14159265) == "3.1416");
  CHECK(brief_text(-0.0) == "0");
  CHECK(brief_text(1e-13) == "0");
  CHECK(brief_text(std::numeric_limits<double>::infinity()) == "endless");
  CHECK(brief_text(Vec3(0, 1.5, -2)) == "0 1.5 -2");
}

TEST_CASE("a text that is not one finite number is none") {
  CHECK(parse_number("+1.5e1") == 15.0);
  for (const char* text : {"", "+", "+-1", "1 ", " 1", "1,5", "0x10", "nan", "inf", "1e999", "one"}) {
    CAPTURE(text);
    CHECK(!parse_number(text).has_value());
  }
}

TEST_CASE("error texts show small numbers, in any locale") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  CHECK_THROWS_WITH_AS((void)Ease::bezier(1.0000001, 0, 1, 1), doctest::Contains("1.0000001"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)Ease::spring(-1e-7, 1), doctest::Contains("-1e-07"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)keyed_curve<double>({{1234567.5, 0}, {1e-7, 1}}), doctest::Contains("time 1e-07 s"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)normalized(Quat(1e-7, NAN, 0, 0)), doctest::Contains("w 1e-07"), std::invalid_argument);
  std::locale::global(before);
}
