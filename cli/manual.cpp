// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "command.hpp"

// The man page and the completions are generated from the options, so that they always match what
// the program accepts.

namespace kinefile::cli {
namespace {

struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--out"
  std::string argument;            ///< empty for a flag
  std::string description;
  std::vector<std::string> choices;
};

struct CommandText {
  std::string name;
  std::string description;
  std::string positionals;
  std::vector<OptionText> options;
};

/// The words of a check like {a,b,c}, which CLI11 keeps as the end of the option's type.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

/// The name of an option's value, without the check that CLI11 adds: "RULE:{keep,extend}",
/// "N:INT in [0 - 30]". Names may have colons, too.
std::string argument_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return {};
  const std::string type = option.get_type_name();
  return type.substr(0, std::min(type.find(":{"), type.find(":INT in [")));
}

std::vector<OptionText> options_of(const CLI::App& app) {
  std::vector<OptionText> options;
  for (const CLI::Option* option : app.get_options()) {
    const bool has_name = !option->get_snames().empty() || !option->get_lnames().empty();
    if (option->get_group().empty() || !has_name) continue;
    OptionText text;
    for (const std::string& name : option->get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) text.names.push_back("--" + name);
    text.argument = argument_of(*option);
    text.description = option->get_description();
    text.choices = choices_of(*option);
    options.push_back(std::move(text));
  }
  return options;
}

std::vector<CommandText> commands_of(const CLI::App& app) {
  std::vector<CommandText> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    CommandText text{command->get_name(), command->get_description(), {}, options_of(*command)};
    for (const CLI::Option* option : command->get_options()) {
      if (!option->get_positional()) continue;
      text.positionals += " " + option->get_name(true);
      if (option->get_items_expected_max() > 1) text.positionals += "...";
    }
    commands.push_back(std::move(text));
  }
  return commands;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

/// A text with everything escaped that is special in roff: backslashes, hyphens, and dots and
/// apostrophes at the start of a line.
std::string escaped_roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool starts_line = escaped.empty() || escaped.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '-' || c == '\\') escaped += '\\';
    escaped += c == '\\' ? 'e' : c;
  }
  return escaped;
}

std::string man_option(const OptionText& option) {
  const std::string argument =
      option.argument.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped_roff(option.argument));
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}.\n", escaped_roff(joined(option.names, ", ")), argument,
                     escaped_roff(option.description));
}

std::string man_page(const CLI::App& app) {
  std::string page = fmt::format(
      ".TH KINEFILE 1 \"\" \"kinefile {}\" \"User Commands\"\n"
      ".SH NAME\nkinefile \\- the motion of skeletons and robots\n"
      ".SH SYNOPSIS\n.B kinefile\n\\fICOMMAND FILE\\fR... [\\fIoptions\\fR]\n"
      ".SH DESCRIPTION\n{}\n",
      kVersion, app.get_description());
  page += ".SH OPTIONS OF EVERY COMMAND\n";
  for (const OptionText& option : options_of(app)) page += man_option(option);
  page += ".SH COMMANDS\n";
  for (const CommandText& command : commands_of(app)) {
    page += fmt::format(".SS \"kinefile {}{}\"\n{}.\n", command.name, command.positionals,
                        command.description);
    for (const OptionText& option : command.options) page += man_option(option);
  }
  page += ".SH NOTES\n.nf\n" + escaped_roff(app.get_footer()) + "\n.fi\n";
  return page;
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> names;
  std::string cases;
  std::string choice_cases;
  std::vector<std::string> global_words;
  const auto add_choices = [&choice_cases](const OptionText& option, const std::string& command) {
    if (option.choices.empty()) return;
    for (const std::string& name : option.names) {
      choice_cases +=
          fmt::format("    {}:{}) words='{}' ;;\n", command, name, joined(option.choices, " "));
    }
  };
  for (const OptionText& option : options_of(app)) {
    global_words.insert(global_words.end(), option.names.begin(), option.names.end());
    add_choices(option, "*");
  }
  for (const CommandText& command : commands_of(app)) {
    names.push_back(command.name);
    std::vector<std::string> words;
    for (const OptionText& option : command.options) {
      words.insert(words.end(), option.names.begin(), option.names.end());
      add_choices(option, command.name);
    }
    cases += fmt::format("    {}) options='{}' ;;\n", command.name, joined(words, " "));
  }
  return fmt::format(
      "# bash completion for kinefile\n"
      "_kinefile() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  local command='' options='' words='' i\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case ${{COMP_WORDS[i]}} in {}) command=${{COMP_WORDS[i]}}; break ;; esac\n"
      "  done\n"
      "  case $command in\n{}  esac\n"
      "  case $command:$before in\n{}  esac\n"
      "  if [[ -n $words ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "  elif [[ $word == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$options {}\" -- \"$word\"))\n"
      "  elif [[ -z $command ]]; then\n"
      "    COMPREPLY=($(compgen -W '{}' -- \"$word\"))\n"
      "  else\n"
      "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _kinefile kinefile\n",
      joined(names, "|"), cases, choice_cases, joined(global_words, " "), joined(names, " "));
}

/// A description inside a zsh specification, where brackets, colons and quotes are special.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':') safe += '\\';
    safe += c == '\'' ? '`' : c;
  }
  return safe;
}

std::string zsh_options(const std::vector<OptionText>& options) {
  std::string specs;
  for (const OptionText& option : options) {
    std::string action;
    if (!option.argument.empty()) {
      action = fmt::format(":{}:", zsh_text(option.argument));
      action += option.choices.empty() ? "_files" : "(" + joined(option.choices, " ") + ")";
    }
    for (const std::string& name : option.names) {
      specs += fmt::format(" \\\n        '{}[{}]{}'", name, zsh_text(option.description), action);
    }
  }
  return specs;
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands;
  std::string cases;
  for (const CommandText& command : commands_of(app)) {
    commands += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.description));
    cases += fmt::format("    {})\n      _arguments{}{} \\\n        '*:file:_files' ;;\n",
                         command.name, zsh_options(command.options), zsh_options(options_of(app)));
  }
  return fmt::format(
      "#compdef kinefile\n"
      "local -a commands\n"
      "commands=(\n{})\n"
      "if (( CURRENT == 2 )); then\n"
      "  _describe command commands\n"
      "else\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n{}  esac\n"
      "fi\n",
      commands, cases);
}

std::string fish_text(std::string text) {
  std::replace(text.begin(), text.end(), '\'', '`');
  return text;
}

std::string fish_option(const OptionText& option, const std::string& condition) {
  std::string line = fmt::format("complete -c kinefile{}", condition);
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.argument.empty()) line += " -r";
  if (!option.choices.empty()) line += fmt::format(" -f -a '{}'", joined(option.choices, " "));
  return line + fmt::format(" -d '{}'\n", fish_text(option.description));
}

std::string fish_completion(const CLI::App& app) {
  std::string text = "# fish completion for kinefile\n";
  for (const OptionText& option : options_of(app)) text += fish_option(option, "");
  for (const CommandText& command : commands_of(app)) {
    text += fmt::format("complete -c kinefile -n __fish_use_subcommand -f -a {} -d '{}'\n",
                        command.name, fish_text(command.description));
    const std::string condition = fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name);
    for (const OptionText& option : command.options) text += fish_option(option, condition);
  }
  return text;
}

}  // namespace

std::string manual(const CLI::App& app, const std::string& kind) {
  if (kind == "man") return man_page(app);
  if (kind == "bash") return bash_completion(app);
  if (kind == "zsh") return zsh_completion(app);
  return fish_completion(app);
}

}  // namespace kinefile::cli
