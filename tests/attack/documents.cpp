// Documents changed by structure and by byte: each is refused with its places, or runs and is written without a NaN.

#include "attack/cases.h"
#include "attack/shown.h"
#include "attack/written.h"

#include <tweenfall/importers/document.h>

namespace tweenfall::attack {

namespace {

std::string fault_of(const DocumentError& error) {
  if (error.problems().empty()) return "refused without a problem";
  for (const Problem& problem : error.problems()) {
    if (problem.message.empty()) return "a problem without a message";
    if (!is_utf8(problem.text())) return "a problem's text is not UTF-8";
  }
  return {};
}

/// Parses it, writes it again, runs it and writes it in every form. TAKEN counts the valid ones.
std::string fault_of_document(const ChangedDocument& made, std::uint64_t& taken) {
  try {
    const Document document = Document::parse(made.text, "attack.json", made.folder);
    ++taken;
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

class Documents final : public Attack {
 public:
  explicit Documents(std::uint64_t seed, const std::string& part = {}) : documents_(seed, part) {}

  std::string show(std::uint64_t number) override { return documents_.make(number).text; }
  std::string run(std::uint64_t number) override { return fault_of_document(documents_.make(number), taken_); }

 private:
  ChangedDocuments documents_;
};

class UnchangedDocuments final : public Attack {
 public:
  std::string show(std::uint64_t number) override { return bytes_of(files_.at(number)); }
  std::string run(std::uint64_t number) override {
    const std::filesystem::path& file = files_.at(number);
    const std::string fault = fault_of_document({bytes_of(file), file.parent_path()}, taken_);
    return fault.empty() ? fault : file.filename().string() + ": " + fault;
  }
  [[nodiscard]] std::uint64_t size() const override { return files_.size(); }

 private:
  std::vector<std::filesystem::path> files_ =
      documents_in({"samples/documents", "tests/data/documents", "../shared/faults"});
};

}  // namespace

std::unique_ptr<Attack> attack_documents(std::uint64_t seed) {
  return std::make_unique<Documents>(seed);
}

std::unique_ptr<Attack> attack_unchanged() {
  return std::make_unique<UnchangedDocuments>();
}

std::unique_ptr<Attack> attack_graphs(std::uint64_t seed) {
  return std::make_unique<Documents>(seed, "graphs");
}

}  // namespace tweenfall::attack
