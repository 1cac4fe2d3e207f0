// Any bytes as a document: refused with places, or a document whose text reads back to itself.

#include <tweenfall/importers/document.h>

#include <cstdlib>

using namespace tweenfall;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  // Reading is what is fuzzed: trial steps would take nearly all of the time.
  const ReadOptions options{.try_steps = false};
  try {
    const std::string text =
        Document::parse({reinterpret_cast<const char*>(bytes), size}, "fuzz.json", "/nowhere", options).text();
    if (Document::parse(text, "again.json", "/nowhere", options).text() != text) std::abort();
  } catch (const DocumentError& error) {
    for (const Problem& problem : error.problems()) (void)problem.text();
  }
  return 0;
}
