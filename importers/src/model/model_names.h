#pragma once

// Makes names unique, so that the second "arm" becomes "arm#2", and valid UTF-8, whatever program wrote them.

#include <tweenfall/importers/shown_text.h>

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace tweenfall::models {

class UniqueNames {
 public:
  /// `name` itself the first time, then "name#2", "name#3", ...
  [[nodiscard]] std::string unique(const std::string& written) {
    const std::string name = utf8_or_latin1(written);
    std::size_t& count = seen_[name];
    std::string result = ++count == 1 ? name : name + "#" + std::to_string(count);
    while (!taken_.insert(result).second) result = name + "#" + std::to_string(++count);
    return result;
  }

 private:
  std::unordered_map<std::string, std::size_t> seen_;
  std::unordered_set<std::string> taken_;
};

}  // namespace tweenfall::models
