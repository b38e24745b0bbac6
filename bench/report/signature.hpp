// Whether a detached signature beside a file covers the file.
#pragma once

#include <string>

namespace canhil::report {

/// One line about the signature of a file: FILE.sig (made by `ssh-keygen -Y sign -n canhil-report`) or
/// FILE.asc (made by `gpg --detach-sign`). It says whether the signature covers the bytes of the file, and
/// names the command that tells who signed; or it says that there is no signature, or that it could not be
/// checked.
std::string signature_line(const std::string& file);

}  // namespace canhil::report
