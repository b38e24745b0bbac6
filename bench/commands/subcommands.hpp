// The subcommands of hil-bench itself: each is added to the program, and leaves its exit code in `code`.
#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench run SCENARIO`: one run and its verdict.
void add_run(command_line::Command app, int& code);

/// `hil-bench report` and `hil-bench compare`: what is done with reports of finished runs.
void add_report(command_line::Command app, int& code);

/// `hil-bench bus local:NAME`: hosts an embedded bus for other programs until interrupted.
void add_bus(command_line::Command app, int& code);

/// `hil-bench diverge A B`: the first frame of the target in which two recorded runs differ. Exit code 1 if
/// they do.
void add_diverge(command_line::Command app, int& code);

/// `hil-bench golden record|check`: what a target answers in some flights, kept, and the first answer of a
/// later one that is another. Exit code 1 if there is one.
void add_golden(command_line::Command app, int& code);

/// `hil-bench conformance`: whether a target keeps the protocol, rule by rule. Exit code 1 if it does not.
void add_conformance(command_line::Command app, int& code);

/// `hil-bench doctor --bus BUS`: what this machine and its interface can do, with remedies. Exit code 1 if
/// something is bad.
void add_doctor(command_line::Command app, int& code);

/// `hil-bench schedulability FILE.dbc`: worst-case response times of all messages. Exit code 1 if one can
/// miss its deadline.
void add_schedulability(command_line::Command app, int& code);

/// `hil-bench log|decode|replay|check`: what can be done with recorded frames.
void add_log(command_line::Command app, int& code);
/// `hil-bench log compare A B`: how far the stamps of two recordings of one bus are apart.
void add_log_compare(command_line::Command log, int& code);

/// `hil-bench dbc lint|show|rules`: DBC files, also of others. Exit code 1 if lint refuses one.
void add_dbc(command_line::Command app, int& code);

}  // namespace canhil::commands
