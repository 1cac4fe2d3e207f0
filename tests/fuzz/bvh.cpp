// Any bytes as BVH.

#include "bvh/reader.h"

using namespace tweenfall;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  try {
    models::ModelProblems problems;
    (void)bvh::read_bvh({reinterpret_cast<const char*>(bytes), size}, "/nowhere/fuzz.bvh", problems);
  } catch (const ModelError&) {
  }
  return 0;
}
