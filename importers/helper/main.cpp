// tweenfall-import-helper FILE: reads a Collada or OBJ file by assimp and writes the model to standard output, so that
// what a malformed file does to assimp it does to this program alone.

#include "assimp/helper.h"

int main(int count, char** words) {
  return tweenfall::assimp::help(count, words);
}
