// Any bytes as glTF, text or binary.

#include "gltf/read/reader.h"

using namespace tweenfall;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  try {
    models::ModelProblems problems;
    (void)gltf::read({reinterpret_cast<const char*>(bytes), size}, "/nowhere/fuzz.gltf", problems);
  } catch (const ModelError&) {
  }
  return 0;
}
