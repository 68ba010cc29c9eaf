// SPDX-License-Identifier: Apache-2.0
// pileus methods: who can do what, feature by method.
// in: nothing, or the name of a column -> out: the support table as text, JSON or a page.
// docs/program.md, "methods"; docs/support.md
#include <memory>

#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/command.h"
#include "tools/pileus/methods_text.h"

namespace pileus {
namespace {

struct MethodsArguments {
    std::string name;
    bool json = false, markdown = false;
};

Status run_methods(const MethodsArguments& arguments) {
    if (arguments.json) return print(support_json());
    if (arguments.markdown) return print(support_markdown());
    if (arguments.name.empty()) return print(support_lines());
    std::string names;
    for (std::size_t c = 0; c < kMethodColumns; ++c) {
        const std::string name = method_column_name(MethodColumn(c));
        if (name == arguments.name) return print(support_lines_of(MethodColumn(c)));
        names += (names.empty() ? "" : ", ") + name;
    }
    return Status::bad_input("pileus methods: no such method, " + quote_text(arguments.name) +
                             ", allowed: " + names);
}

}  // namespace

void add_methods(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("methods", "Print what each method can do");
    const auto arguments = std::make_shared<MethodsArguments>();
    CLI::Option* name =
        command->add_option("name", arguments->name, "One method, in words")->type_name("NAME");
    CLI::Option* json = command->add_flag("--json", arguments->json, "All of it as JSON");
    CLI::Option* page =
        command->add_flag("--markdown", arguments->markdown, "All of it as docs/support.md has it");
    json->excludes(page)->excludes(name);
    page->excludes(name);
    command->footer(help_example("pileus methods photon-grid"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_methods(*arguments); }; });
}

}  // namespace pileus
