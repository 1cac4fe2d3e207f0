#include "whole_file.h"

#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace tweenfall::gltf {

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path beside = file;
  beside += ".part-" + std::to_string(::getpid());
  std::error_code failed;
  {
    std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) {
      std::filesystem::remove(beside, failed);
      throw std::runtime_error("cannot write in folder \"" + file.parent_path().string() + "\"");
    }
  }
  std::filesystem::rename(beside, file, failed);
  if (!failed) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  throw std::runtime_error("cannot replace the file: " + failed.message());
}

}  // namespace tweenfall::gltf
