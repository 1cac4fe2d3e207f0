#pragma once

/// The document: JSON that people write, checked once, whole.
///
/// Reading gives either a `Document` or a `DocumentError` with every problem in it, each with its
/// line and column, a pointer, what is wrong and what would be right. A document keeps what its author wrote, so
/// that writing it back gives the same text, and `stage` makes of it what runs.

#include <tweenfall/importers/model.h>
#include <tweenfall/physics/expression_system.h>
#include <tweenfall/physics/stage/description.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

/// A note is about what is right and perhaps not meant; an error is a fault, for which a document is refused.
enum class Severity { error, note };

/// One thing to say about a place of a document.
struct Problem {
  Severity severity = Severity::error;
  std::string file;      ///< as given
  std::size_t line = 0;  ///< from 1; 0 when the whole file is meant
  std::size_t column = 0;
  std::string pointer;             ///< JSON pointer, "/clips/drop/..."
  std::string message;             ///< what is wrong, and the nearest valid name where there is one
  std::string excerpt;             ///< the line of the file, or of a very long one what stands around the place
  std::size_t excerpt_column = 1;  ///< column of the excerpt's first character
  std::size_t length = 1;          ///< how many bytes are meant
  std::size_t count = 1;           ///< more where it says how many others are not listed

  /// "file:line:column: error: message (at pointer)", or "note:", then the line and a caret, as compilers print it.
  /// Always UTF-8.
  [[nodiscard]] std::string text() const;
};

class DocumentError : public std::runtime_error {
 public:
  /// @param problems  at least one @param notes  what was noted before the reader gave up
  explicit DocumentError(std::vector<Problem> problems, std::vector<Problem> notes = {});
  [[nodiscard]] const std::vector<Problem>& problems() const noexcept { return problems_; }  ///< errors alone
  [[nodiscard]] const std::vector<Problem>& notes() const noexcept { return notes_; }

 private:
  std::vector<Problem> problems_, notes_;
};

/// Longer texts are no documents of people, and are refused before they fill memory.
inline constexpr std::size_t largest_document = std::size_t{1} << 28;  // bytes

struct ReadOptions {
  bool allow_outside = false;  ///< imports may leave the document's folder
  bool try_steps = true;       ///< a copy takes up to 256 steps on trial, for notes of what will not last
};

class Document {
 public:
  // Moving copies: it is as cheap, and what was moved from stays what it was.
  Document(const Document&) noexcept = default;
  Document& operator=(const Document&) noexcept = default;

  /// @throws DocumentError with all problems.
  [[nodiscard]] static Document read(const std::filesystem::path& file, const ReadOptions& options = {});
  /// @param name    stands for the file in problems
  /// @param folder  imports are relative to it
  [[nodiscard]] static Document parse(std::string_view text, const std::string& name,
                                      const std::filesystem::path& folder, const ReadOptions& options = {});

  /// Nodes, clips, bodies and rules, imports included.
  [[nodiscard]] const StageDescription& stage() const noexcept;

  /// Systems of first order that it writes down; each is a clip of the stage, too.
  [[nodiscard]] const std::vector<ExpressionSystem>& systems() const noexcept;

  /// What its author may want to know though the document is valid: names of ours nearly hit, what is too stiff or too
  /// fast for the step, bodies that start in each other, what a rule's pattern leaves out, what was lost of a model.
  [[nodiscard]] const std::vector<Problem>& notes() const noexcept;

  /// What turned out to be wrong with a node of `stage`, such as a place that no file can hold: the message with the
  /// node's place, or that of the import that brought it.
  [[nodiscard]] Problem problem_of_node(std::size_t node, std::string message) const;

  /// The document as text: two spaces, one key per line, defaults left out. Reading and writing that again gives the
  /// same text.
  [[nodiscard]] std::string text() const;

  /// A document of a model's nodes and clips.
  [[nodiscard]] static Document from_model(const Model& model);

 private:
  struct Content;
  explicit Document(std::shared_ptr<const Content> content);
  std::shared_ptr<const Content> content_;
};

/// The JSON Schema (draft-07) of the document, as text.
[[nodiscard]] std::string document_schema();

/// A commented starting document.
[[nodiscard]] std::string starting_document();

}  // namespace tweenfall
