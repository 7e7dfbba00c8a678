// What is here: errors of CLI11 rewritten as one sentence that names the nearest flag.
#include "app/usage_error.h"

#include <fmt/format.h>

#include "app/common.h"
#include "io/error.h"

namespace perfora::app {

namespace {

/// The subcommand that was being read, or the program itself.
const CLI::App* active(const CLI::App& program) {
  const auto parsed = program.get_subcommands();
  return parsed.empty() ? &program : active(*parsed.front());
}

std::vector<std::string> flag_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> subcommand_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); }))
    names.push_back(command->get_name());
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// First line of CLI11's own message, without a closing full stop and the name before it, which is empty for a flag
/// that --help does not list.
std::string first_line(const std::string& message) {
  std::string line = message.substr(0, message.find('\n'));
  if (line.starts_with(": ")) line.erase(0, 2);
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line;
}

std::string suggestion(const std::string& nearest) {
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::string unexpected_text(const CLI::App& program, const CLI::App& command) {
  const std::vector<std::string> extras = command.remaining(true);
  if (extras.empty()) return {};
  const std::string& first = extras.front();
  if (&command == &program && !first.starts_with("-")) {
    const auto names = subcommand_names(program);
    return fmt::format("unknown subcommand \"{}\"; allowed are {}{}", first, joined(names),
                       suggestion(io::nearest_name(first, names)));
  }
  if (first.starts_with("-"))
    return fmt::format("unknown flag {}{}", first,
                       suggestion(io::nearest_name(first.substr(0, first.find('=')), flag_names(command))));
  return fmt::format("\"{}\" was not expected here", first);
}

}  // namespace

int report_usage_error(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    program.exit(error);
    return exit_ok;
  }
  const CLI::App& command = *active(program);
  const std::string where = &command == &program ? "perfora" : "perfora " + command.get_name();
  std::string text;
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) text = unexpected_text(program, command);
  if (&command == &program && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    text = unexpected_text(program, command);
    if (text.empty()) text = "a subcommand is needed: " + joined(subcommand_names(program));
  }
  if (text.empty()) text = first_line(error.what());
  io::log_error(fmt::format("{}: {}; `{} --help` lists what can be given", where, text, where));
  return exit_input;
}

}  // namespace perfora::app
