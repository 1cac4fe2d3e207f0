// Any bytes as FBX, text or binary.

#include "fbx/reader.h"

using namespace tweenfall;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  try {
    models::ModelProblems problems;
    (void)fbx::read({reinterpret_cast<const char*>(bytes), size}, "/nowhere/fuzz.fbx", problems);
  } catch (const ModelError&) {
  }
  return 0;
}
