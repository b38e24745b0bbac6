// hil-bench reference: prints every key of scenario and campaign files.
#include "bench/reference/report.hpp"

#include <memory>

#include "bench/commands/campaign.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/report/file.hpp"
#include "bench/scenario/commands.hpp"

namespace canhil::commands {

void add_reference(command_line::Command app, int& code) {
  auto json = std::make_shared<bool>(false), schema = std::make_shared<bool>(false);
  const auto command = app.add_subcommand(std::string(reference_name), std::string(reference_summary));
  command.add_flag("--json", *json, "JSON instead of Markdown");
  command.add_flag("--schema", *schema, "JSON schema of scenario files, for editors");
  command.on_given([&code, json, schema] {
    scenario::forbid_commands();  // the readers are given keys to see what they ask for
    const auto parts = reference::parts();
    const auto shown = report::write_stdout(*schema ? reference::schema(parts)
                                            : *json ? reference::json(parts)
                                                    : reference::markdown(parts));
    code = static_cast<int>(shown ? ExitCode::pass : complain(shown.error()));
  });
}

}  // namespace canhil::commands
