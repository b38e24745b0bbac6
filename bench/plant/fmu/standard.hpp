// The C functions of an FMU for co-simulation that the bench calls: FMI 2.0.5 (sections 2.1 and 4.2) and FMI
// 3.0.2 (sections 2.2, 2.3 and 4.2). An FMU exports them by these names.
#pragma once

#include <cstddef>
#include <cstdint>

namespace canhil::plant::fmu::standard {

/// What the functions return, in both versions (as a C enumeration).
enum Status : int { ok, warning, discard, error, fatal, pending };

using Instance = void*;
using Environment = void*;
using Reference = std::uint32_t;

/// fmi2SetReal, fmi2GetReal ...: the values of scalar variables.
template <class T>
using Set2 = int(Instance, const Reference[], std::size_t, const T[]);
template <class T>
using Get2 = int(Instance, const Reference[], std::size_t, T[]);
/// fmi3SetFloat64, fmi3GetFloat64 ...: the elements of variables, one variable after the other.
template <class T>
using Set3 = int(Instance, const Reference[], std::size_t, const T[], std::size_t);
template <class T>
using Get3 = int(Instance, const Reference[], std::size_t, T[], std::size_t);
/// Functions whose only argument is the instance.
using Change = int(Instance);
using Free = void(Instance);

namespace fmi2 {

using Boolean = int;
inline constexpr int co_simulation = 1;

struct Callbacks {
  void (*logger)(Environment, const char* instance, int status, const char* category, const char* message,
                 ...);
  void* (*allocate)(std::size_t count, std::size_t size);
  void (*free)(void*);
  void (*step_finished)(Environment, int status);
  Environment environment;
};
using Instantiate = Instance(const char* name, int kind, const char* guid, const char* resources,
                             const Callbacks*, Boolean visible, Boolean log);
using SetupExperiment = int(Instance, Boolean tolerance_defined, double tolerance, double start_s,
                            Boolean stop_defined, double stop_s);
using DoStep = int(Instance, double from_s, double step_s, Boolean no_return_to_earlier);
/// After DoStep returned discard, this kind of status says whether the FMU asks for the end of the
/// simulation.
inline constexpr int terminated = 3;
using GetBooleanStatus = int(Instance, int kind, Boolean* value);

}  // namespace fmi2

namespace fmi3 {

using Log = void(Environment, int status, const char* category, const char* message);
using IntermediateUpdate = void(Environment, double, bool, bool, bool, bool, bool*, double*);
using Instantiate = Instance(const char* name, const char* token, const char* resources, bool visible,
                             bool log, bool event_mode_used, bool early_return_allowed,
                             const Reference intermediate[], std::size_t intermediates, Environment, Log*,
                             IntermediateUpdate*);
using EnterInitializationMode = int(Instance, bool tolerance_defined, double tolerance, double start_s,
                                    bool stop_defined, double stop_s);
using DoStep = int(Instance, double from_s, double step_s, bool no_return_to_earlier,
                   bool* event_handling_needed, bool* terminate, bool* early_return, double* reached_s);

}  // namespace fmi3

}  // namespace canhil::plant::fmu::standard
