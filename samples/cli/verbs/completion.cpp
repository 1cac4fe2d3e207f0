// tweenfall completion: verbs and options for bash, zsh and fish, from the one table of verbs.

#include "report/terminal.h"
#include "verbs/verbs.h"

namespace tweenfall::cli {

namespace {

std::string options_of(const CommandLine& line, const Verb& verb) {
  std::string names;
  for (const OptionName& option : line.options(verb.name)) names += (names.empty() ? "" : " ") + option.name;
  if (&verb == &completion_verb) names += " bash zsh fish";
  return names;
}

/// Quotes a text for use inside single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out + "'";
}

std::string verb_names() {
  std::string names;
  for (const Verb* verb : all_verbs()) names += (names.empty() ? "" : " ") + std::string(verb->name);
  return names;
}

std::string bash(const CommandLine& line) {
  std::string out =
      "_tweenfall() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} choices=\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W " +
      quoted(verb_names() + " --help --version") +
      " -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${COMP_WORDS[1]} in\n";
  for (const Verb* verb : all_verbs())
    out += std::string("    ") + verb->name + ") choices=" + quoted(options_of(line, *verb)) + " ;;\n";
  return out +
         "  esac\n"
         "  if [[ $word == -* || ${COMP_WORDS[1]} == completion ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$choices\" -- \"$word\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _tweenfall tweenfall\n";
}

std::string zsh(const CommandLine& line) {
  std::string out =
      "#compdef tweenfall\n"
      "_tweenfall() {\n"
      "  local -a verbs choices\n"
      "  verbs=(\n";
  for (const Verb* verb : all_verbs()) out += "    " + quoted(std::string(verb->name) + ":" + verb->summary) + "\n";
  out +=
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe 'verb' verbs\n"
      "    return\n"
      "  fi\n"
      "  case $words[2] in\n";
  for (const Verb* verb : all_verbs())
    out += std::string("    ") + verb->name + ") choices=(" + options_of(line, *verb) + ") ;;\n";
  return out +
         "  esac\n"
         "  if [[ $PREFIX == -* || $words[2] == completion ]]; then\n"
         "    compadd -- $choices\n"
         "  else\n"
         "    _files\n"
         "  fi\n"
         "}\n"
         "if [[ $funcstack[1] == _tweenfall ]]; then _tweenfall \"$@\"; else compdef _tweenfall tweenfall; fi\n";
}

std::string fish(const CommandLine& line) {
  std::string out;
  for (const Verb* row : all_verbs()) {
    const Verb& verb = *row;
    out += std::string("complete -c tweenfall -n __fish_use_subcommand -f -a ") + verb.name + " -d " +
           quoted(verb.summary) + "\n";
    const std::string seen = quoted(std::string("__fish_seen_subcommand_from ") + verb.name);
    for (const OptionName& option : line.options(verb.name)) {
      const bool is_long = option.name.starts_with("--");
      out += "complete -c tweenfall -n " + seen + (is_long ? " -l " : " -s ") + option.name.substr(is_long ? 2 : 1) +
             (option.takes_value ? " -r" : "") + " -d " + quoted(option.says) + "\n";
    }
    if (&verb == &completion_verb) out += "complete -c tweenfall -n " + seen + " -f -a 'bash zsh fish'\n";
  }
  return out;
}

Run declare_completion(Arguments& arguments) {
  auto shell = std::make_shared<std::string>();
  arguments.word("SHELL", *shell, {"bash", "zsh", "fish"}, "bash, zsh or fish");
  return [shell] {
    const CommandLine line(all_verbs());
    print(*shell == "bash" ? bash(line) : *shell == "zsh" ? zsh(line) : fish(line));
    return 0;
  };
}

}  // namespace

const Verb completion_verb{"completion", "print the completion of a shell", "source <(tweenfall completion bash)",
                           declare_completion};

}  // namespace tweenfall::cli
