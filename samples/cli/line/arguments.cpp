#include "line/arguments.h"

#include "report/did_you_mean.h"
#include "report/terminal.h"

#include <tweenfall/curves/number_text.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <map>
#include <sstream>

namespace tweenfall::cli {

namespace {

CLI::App& app_of(void* implementation) {
  return *static_cast<CLI::App*>(implementation);
}

double number_from(const std::string& option, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value) throw CLI::ValidationError(option, "\"" + text + "\" is not a number");
  return *value;
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// The first argument that looks like an option but is none of the verb's.
std::optional<std::string> unknown_option(const CLI::App& verb, const std::vector<std::string>& arguments) {
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& name : option->get_snames()) known.push_back("-" + name);
  }
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    if (argument.size() < 2 || argument[0] != '-' || parse_number(argument)) continue;
    const bool is_long = argument[1] == '-';
    const std::string name = is_long ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    return "unknown option " + name + did_you_mean(name, known);
  }
  return std::nullopt;
}

}  // namespace

void Arguments::file(const char* name, std::string& value, const char* says) {
  app_of(implementation_).add_option(name, value, says)->required()->type_name("");
}

void Arguments::optional_file(const char* name, std::string& value, const char* says) {
  app_of(implementation_).add_option(name, value, says)->type_name("");
}

void Arguments::files(const char* name, std::vector<std::string>& values, const char* says) {
  app_of(implementation_).add_option(name, values, says)->required()->type_name("");
}

void Arguments::word(const char* name, std::string& value, const std::vector<std::string>& choices, const char* says) {
  app_of(implementation_)
      .add_option_function<std::string>(
          name,
          [&value, name, choices](const std::string& text) {
            if (std::find(choices.begin(), choices.end(), text) == choices.end())
              throw CLI::ValidationError(name, "there is no \"" + text + "\"" + did_you_mean(text, choices) +
                                                   "\n  it is one of " + one_of(choices));
            value = text;
          },
          says)
      ->required()
      ->type_name("");
}

void Arguments::flag(const char* option, bool& value, const char* says) {
  app_of(implementation_).add_flag(option, value, says);
}

void Arguments::text(const char* option, const char* kind, std::optional<std::string>& value, const char* says) {
  app_of(implementation_)
      .add_option_function<std::string>(
          option, [&value](const std::string& text) { value = text; }, says)
      ->type_name(kind);
}

void Arguments::texts(const char* option, const char* kind, std::vector<std::string>& values, const char* says) {
  app_of(implementation_)
      .add_option(option, values, says)
      ->type_name(kind)
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void Arguments::number(const char* option, const char* kind, std::optional<double>& value, const char* says) {
  app_of(implementation_)
      .add_option_function<std::string>(
          option, [&value, option](const std::string& text) { value = number_from(option, text); }, says)
      ->type_name(kind);
}

void Arguments::output(std::string& value, const char* kind, const char* says) {
  app_of(implementation_).add_option("-o,--output", value, says)->type_name(kind);
}

void Arguments::numbers(const char* option, const char* kind, std::vector<double>& values, const char* says) {
  app_of(implementation_)
      .add_option_function<std::vector<std::string>>(
          option,
          [&values, option](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
              for (const std::string& part : split_at_commas(text)) values.push_back(number_from(option, part));
          },
          says)
      ->type_name(kind)
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

struct CommandLine::Implementation {
  CLI::App app{"tweenfall: scripted and simulated motion on one timeline", "tweenfall"};
  std::vector<std::string> names;
  std::map<std::string, Run, std::less<>> runs;
};

CommandLine::CommandLine(std::span<const Verb* const> verbs) : implementation_(std::make_unique<Implementation>()) {
  CLI::App& app = implementation_->app;
  app.set_version_flag("--version", "tweenfall " TWEENFALL_VERSION, "print the version");
  app.set_help_flag("-h,--help", "print this help");
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  app.get_formatter()->label("REQUIRED", "");
  app.require_subcommand(1);
  app.footer(
      "\"-\" as a file is standard input or output. Exit code: 0 done, 1 the file or the run has a fault, 2 wrong "
      "usage.");
  for (const Verb* row : verbs) {
    const Verb& verb = *row;
    CLI::App& sub = *app.add_subcommand(verb.name, verb.summary);
    sub.group("Verbs");
    sub.footer(std::string("Example:\n  ") + verb.example);
    Arguments arguments(&sub);
    implementation_->names.emplace_back(verb.name);
    implementation_->runs.emplace(verb.name, verb.declare(arguments));
  }
}

CommandLine::~CommandLine() = default;

int CommandLine::run(const std::vector<std::string>& arguments) {
  CLI::App& app = implementation_->app;
  const std::vector<std::string>& names = implementation_->names;
  if (!arguments.empty() && !arguments[0].starts_with('-') &&
      std::find(names.begin(), names.end(), arguments[0]) == names.end())
    throw UsageError("there is no verb \"" + arguments[0] + "\"" + did_you_mean(arguments[0], names) +
                     "\n  the verbs are " + listed(names) +
                     "\n  tweenfall --help says what they do, tweenfall VERB --help says more of one");
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::Success& success) {
    std::ostringstream asked;
    const int code = app.exit(success, asked, asked);
    print(asked.str());
    return code;
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& asked = chosen.empty() ? app : *chosen[0];
    const std::string help =
        std::string("\n  ") + (chosen.empty() ? "" : "tweenfall ") + asked.get_name() + " --help says more";
    // The verb itself comes first if there is one.
    std::vector<std::string> after = arguments;
    if (!chosen.empty()) after.erase(after.begin());
    if (const auto unknown = unknown_option(asked, after)) throw UsageError(*unknown + help);
    throw UsageError(error.what() + help);
  }
  return implementation_->runs.find(app.get_subcommands().at(0)->get_name())->second();
}

std::vector<OptionName> CommandLine::options(std::string_view verb) const {
  std::vector<OptionName> names;
  for (const CLI::Option* option : implementation_->app.get_subcommand(std::string(verb))->get_options()) {
    const bool takes_value = option->get_expected_min() > 0;
    for (const std::string& name : option->get_snames())
      names.push_back({"-" + name, option->get_description(), takes_value});
    for (const std::string& name : option->get_lnames())
      names.push_back({"--" + name, option->get_description(), takes_value});
  }
  return names;
}

}  // namespace tweenfall::cli
