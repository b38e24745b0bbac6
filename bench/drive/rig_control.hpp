// Fault actions on the target's process or on the bus interface, in contrast to actions on frames.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "bench/drive/link.hpp"
#include "bench/drive/target_process.hpp"
#include "bench/faults/injector.hpp"
#include "bench/faults/place.hpp"

namespace canhil::drive {

/// The kernel's data about an interface, and whether the bench may set it up and down.
struct InterfaceFacts {
  faults::Place::Interface kind = faults::Place::Interface::none;
  bool may_set = false;
};
InterfaceFacts interface_facts(const std::string& bus);

class RunRigControl final : public faults::RigControl {
 public:
  /// `targets`: empty until they are started. `link`: its posted frames are sent before the rig changes
  /// anything. Both must outlive this object. `restart`: restarts the targets.
  RunRigControl(std::string bus, TargetPrograms& targets, Link& link,
                std::function<void(std::int64_t t_us)> restart);
  ~RunRigControl() override;

  void pause_target() override;
  void resume_target() override;
  void restart_target(std::int64_t t_us) override;
  void report_error(const Frame& error) override;
  void interface_down(std::int64_t for_us) override;
  void interface_up() override;

 private:
  void flush();

  std::string bus_;
  TargetPrograms& targets_;
  Link& link_;
  std::function<void(std::int64_t)> restart_;
  std::thread up_;   // sets the interface up again
  int errors_ = -1;  // a socket on the interface, opened on demand
};

}  // namespace canhil::drive
