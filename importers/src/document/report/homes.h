#pragma once

// Finds the place where a name that an object does not know is valid; from the forms, so for every field.

#include "document/form.h"

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

class Homes {
 public:
  explicit Homes(const Form& root);

  // `"; it belongs in \"world\""`, or `"; did you mean \"step\" in \"world\"?"` for names in other programs and similar
  // names, or empty.
  // @param around the objects around `here`, the outermost first
  [[nodiscard]] std::string of(std::string_view name, const Form& here, std::span<const Form* const> around) const;

  // The form of a value of this name where it is valid, if there is only one such place nearby.
  [[nodiscard]] const Form* meant_form(std::string_view name, const Form& here,
                                       std::span<const Form* const> around) const;

 private:
  struct Object {
    const Form* form;
    std::string where;     // `in "world"`, `in a node of "nodes"`
    const Object* holder;  // null for the whole document
    std::size_t depth;     // number of objects around it
  };

  void add(const Form& form, std::string what, const std::string& field, bool one_of_many, const Object* holder);
  [[nodiscard]] std::string near(std::string_view name, const Form& here, std::span<const Form* const> around) const;
  [[nodiscard]] static bool is_in(const Object& object, const Form& holder);
  [[nodiscard]] std::string anywhere(std::string_view name, const Form& here) const;
  using Meant = std::string (Form::*)(std::string_view) const;
  [[nodiscard]] std::string meant_inside(std::string_view name, const Form& here, Meant meant) const;

  std::deque<Object> objects_;  // those nearest to the whole document first
};

}  // namespace tweenfall::document
