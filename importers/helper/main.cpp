// tweenfall-import-helper FILE: reads a Collada or OBJ file by assimp and writes the model to standard output, so that
// a malformed file that breaks assimp breaks only this program.

#include "assimp/helper.h"

int main(int count, char** words) {
  return tweenfall::assimp::help(count, words);
}
