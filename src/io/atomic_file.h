#pragma once

#include <functional>
#include <string>

namespace uncertainty_identification {

/// Whether the name, with links followed, is that of a device, a pipe or a socket.
bool isDeviceOrPipe(const std::string& path);

/// Writes a file so that a reader finds the old one or the complete new one, never a part, also
/// after a crash: `write` gets a temporary name in the same folder and creates that file; it is
/// then synchronised to the disk and renamed. When `write` throws, the temporary file is removed
/// and an existing file stays as it was. A link is followed and stays a link. Devices and pipes
/// cannot be replaced: `write` gets their own name. Throws FileError naming the file and the
/// system's reason.
void writeAtomically(const std::string& path,
                     const std::function<void(const std::string& temporary)>& write);

/// The same for a content that is in memory.
void writeFileAtomically(const std::string& path, const std::string& content);

/// Renames a file or folder, which has its new name also after a crash. Throws FileError as above.
void renameDurably(const std::string& from, const std::string& to);

}  // namespace uncertainty_identification
