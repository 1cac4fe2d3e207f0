// Documents changed by structure and by byte: each is refused with its places, or runs and is written without a NaN.

#include "attack/mutation.h"
#include "attack/shown.h"
#include "attack/written.h"

#include <tweenfall/importers/document.h>

namespace tweenfall::attack {

namespace {

class Documents final : public Attack {
 public:
  explicit Documents(std::uint64_t seed) : seed_(seed), files_(seed_documents()) {}

  std::string show(std::uint64_t number) override { return text_of(number).text; }

  std::string run(std::uint64_t number) override {
    const Case made = text_of(number);
    try {
      const Document document = Document::parse(made.text, "attack.json", made.folder);
      ++taken_;
      const std::string text = document.text();
      if (const std::string fault = fault_of_json(text); !fault.empty()) return "the document written again: " + fault;
      return fault_of_run(document.stage(), 0.4);
    } catch (const DocumentError& error) {
      return fault_of(error);
    } catch (const std::bad_alloc&) {
      return "memory ran out";
    } catch (const std::exception& error) {
      return std::string("a valid document ends with: ") + error.what();
    }
  }

 private:
  struct Case {
    std::string text;
    std::filesystem::path folder;
  };

  Case text_of(std::uint64_t number) const {
    Random random = random_of(seed_, number);
    const std::filesystem::path& file = files_[below(random, files_.size())];
    std::string text = attack::bytes_of(file);
    if (below(random, 4) != 0) {
      nlohmann::ordered_json document = nlohmann::ordered_json::parse(text, nullptr, false, true);
      if (!document.is_discarded()) {
        mutate_structure(random, document);
        return {document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), file.parent_path()};
      }
    }
    mutate_bytes(random, text);
    return {text, file.parent_path()};
  }

  static std::vector<std::filesystem::path> seed_documents() {
    const std::filesystem::path source = TWEENFALL_SOURCE_DIR;
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"samples/documents", "tests/data/documents/good", "../shared/faults"}) {
      if (!std::filesystem::exists(source / folder)) continue;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
        if (entry.path().extension() == ".json" && entry.file_size() < 40'000) files.push_back(entry.path());
      }
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  static std::string fault_of(const DocumentError& error) {
    if (error.problems().empty()) return "refused without a problem";
    for (const Problem& problem : error.problems()) {
      if (problem.message.empty()) return "a problem without a message";
      if (!is_utf8(problem.text())) return "a problem's text is not UTF-8";
    }
    return {};
  }

  std::uint64_t seed_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace

std::unique_ptr<Attack> attack_documents(std::uint64_t seed) {
  return std::make_unique<Documents>(seed);
}

}  // namespace tweenfall::attack
