// What is here: `perfora completion` and what it prints. What is not: the examples of --help (examples.cpp).
#include "app/completion.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "app/common.h"
#include "io/provenance.h"

namespace perfora::app {

namespace {

std::vector<const CLI::App*> shown_commands(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// Flags that --help shows, without positional arguments.
std::vector<const CLI::Option*> shown_flags(const CLI::App& command) {
  std::vector<const CLI::Option*> flags;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty() && !option->get_lnames().empty()) flags.push_back(option);
  return flags;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

std::string with_replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// A text within single quotes of a shell, within brackets of zsh's _arguments.
std::string zsh_quoted(std::string text) {
  for (const char* special : {"\\", "[", "]", ":"}) text = with_replaced(text, special, std::string("\\") + special);
  return with_replaced(text, "'", "'\\''");
}

std::string roff(std::string text) {
  text = with_replaced(std::move(text), "\\", "\\e");
  text = with_replaced(std::move(text), "-", "\\-");
  text = with_replaced(std::move(text), "\n.", "\n\\&.");
  return text.starts_with('.') || text.starts_with('\'') ? "\\&" + text : text;
}

std::string type_of(const CLI::Option& option) {
  return takes_value(option) ? " " + (option.get_type_name().empty() ? "VALUE" : option.get_type_name()) : "";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string names, cases;
  for (const CLI::App* command : shown_commands(program)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    std::string flags;
    for (const CLI::Option* option : shown_flags(*command)) flags += " --" + option->get_lnames().front();
    cases += fmt::format("    {}) flags=\"{}\" ;;\n", command->get_name(), flags.substr(flags.empty() ? 0 : 1));
  }
  return fmt::format(
      "# Completion of perfora for bash, written by `perfora completion bash`.\n"
      "_perfora() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} flags=\"\"\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  case $word in\n"
      "    -*) COMPREPLY=($(compgen -W \"$flags\" -- \"$word\")) ;;\n"
      "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o filenames -F _perfora perfora\n",
      names, cases);
}

std::string zsh_completion(const CLI::App& program) {
  std::string names, cases;
  for (const CLI::App* command : shown_commands(program)) {
    names += fmt::format("    '{}:{}'\n", command->get_name(), zsh_quoted(command->get_description()));
    cases += fmt::format("    {})\n      _arguments \\\n", command->get_name());
    for (const CLI::Option* option : shown_flags(*command))
      cases += fmt::format("        '*--{}[{}]{}' \\\n", option->get_lnames().front(),
                           zsh_quoted(option->get_description()), takes_value(*option) ? ":value:_files" : "");
    cases += "        '*:file:_files'\n      ;;\n";
  }
  return fmt::format(
      "#compdef perfora\n"
      "# Completion of perfora for zsh, written by `perfora completion zsh`.\n"
      "_perfora() {{\n"
      "  local -a commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n{}  esac\n"
      "}}\n"
      "(( $+functions[compdef] )) && compdef _perfora perfora\n",
      names, cases);
}

std::string manual_page(const CLI::App& program) {
  std::string page = fmt::format(
      ".TH PERFORA 1 \"\" \"perfora {}\" \"User Commands\"\n.SH NAME\nperfora \\- {}\n.SH SYNOPSIS\n.B perfora\n"
      ".I COMMAND\n[\\fIarguments\\fR]\n.SH COMMANDS\n",
      io::program_version(), roff(program.get_description()));
  for (const CLI::App* command : shown_commands(program)) {
    page += fmt::format(".SS {}\n{}\n", command->get_name(), roff(command->get_description()));
    for (const CLI::Option* option : command->get_options())
      if (!option->get_group().empty() && option->get_positional())
        page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(option->get_name(true)), roff(option->get_description()));
    for (const CLI::Option* option : shown_flags(*command))
      page += fmt::format(".TP\n\\fB\\-\\-{}\\fR{}\n{}\n", roff(option->get_lnames().front()), roff(type_of(*option)),
                          roff(option->get_description()));
    if (!command->get_footer().empty()) page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command->get_footer()));
  }
  return page + fmt::format(".SH EXIT STATUS\n{}\n", roff(program.get_footer()));
}

void add_completion(CLI::App& program, int& exit_code) {
  auto form = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("completion", "Print completion for bash or zsh, or the manual page");
  command->add_option("FORM", *form, "bash, zsh, or man for the manual page")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "man"}).description(""));
  command->callback([form, &program, &exit_code] {
    print_text(*form == "bash"  ? bash_completion(program)
               : *form == "zsh" ? zsh_completion(program)
                                : manual_page(program));
    exit_code = exit_ok;
  });
}

}  // namespace perfora::app
