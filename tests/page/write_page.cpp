// Writes the example as a page and in every other form, to be tested and looked at: write_page FOLDER

#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/recording_file.h>

#include "page/example_stage.h"

#include <exception>
#include <fstream>
#include <iostream>

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: write_page FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    const tweenfall::StageDescription stage = tweenfall::test::example_stage();
    const tweenfall::Recording recording = tweenfall::test::example_recording();
    for (const char* name : {"example.html", "example.json", "example.svg", "example.csv", "example.glb"})
      tweenfall::save_recording(recording, stage, folder / name);
    std::ofstream(folder / "example_plot.svg") << tweenfall::plot_svg(stage, &recording);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << "\n";
    return 1;
  }
}
