// The subcommands of hil-bench. Each function adds one subcommand to the program; the subcommand stores its
// exit code in `code`.
#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// The description of an argument that is a log.
inline constexpr const char* log_to_read =
    "log: candump, ASC, BLF, TRC, SavvyCAN's CSV, pcap or pcapng; may be a pipe or compressed with gzip";

/// `hil-bench run SCENARIO`: one run and its verdict.
void add_run(command_line::Command app, int& code);

/// `hil-bench new mapping|scenario FILE`: writes a file to begin with.
void add_new(command_line::Command app, int& code);

/// `hil-bench report` and `hil-bench compare`: commands for reports of finished runs.
void add_report(command_line::Command app, int& code);

/// `hil-bench bus local:NAME`: hosts an embedded bus for other programs until interrupted.
void add_bus(command_line::Command app, int& code);

/// `hil-bench diverge A B`: finds the first frame of the target that differs between two recorded runs. Exit
/// code 1 if a frame differs.
void add_diverge(command_line::Command app, int& code);

/// `hil-bench golden record|check`: stores a target's answers in some flights, and later reports the first
/// answer that differs. Exit code 1 if an answer differs.
void add_golden(command_line::Command app, int& code);

/// `hil-bench conformance`: tests the protocol rules one by one. Exit code 1 if the target breaks a rule.
void add_conformance(command_line::Command app, int& code);

/// `hil-bench doctor --bus BUS`: reports what this machine and its interface can do, and how to solve the
/// problems that it finds. Exit code 1 if a finding is bad.
void add_doctor(command_line::Command app, int& code);

/// `hil-bench schedulability FILE.dbc`: computes the worst-case response times of all messages. Exit code 1
/// if a message can miss its deadline.
void add_schedulability(command_line::Command app, int& code);

/// `hil-bench log|replay|check`: commands for recorded frames.
void add_log(command_line::Command app, int& code);
/// `hil-bench decode LOG --dbc FILE`: prints the values of recorded frames.
void add_decode(command_line::Command app, int& code);
/// `hil-bench log compare A B`: reports the differences between the time stamps of two recordings of one bus.
void add_log_compare(command_line::Command log, int& code);

/// `hil-bench dbc lint|show|check|extract|wireshark|rules`: commands for DBC files of any project and for
/// mappings. Exit code 1 if lint rejects a file or check finds a warning.
void add_dbc(command_line::Command app, int& code);

}  // namespace canhil::commands
