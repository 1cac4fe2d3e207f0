// Stores the sample character as a binary glTF file.

#include "character.h"

#include <exception>
#include <iostream>

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::cerr << "usage: make_character FILE.glb\n";
    return 2;
  }
  try {
    tweenfall::save_glb(tweenfall::character::make_character(), arguments[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
