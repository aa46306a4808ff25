#pragma once

namespace uncertainty_identification {

/// How many threads to compute with, at least 1: `asked` (estimation.threads), or for kAutomatic
/// all processor cores but one, so that a running node keeps a core for recording. The number of
/// threads never changes a result.
int threadCount(int asked);

/// From now on kAutomatic means all processor cores in this process: for programs that record
/// nothing meanwhile.
void useAllCores();

}  // namespace uncertainty_identification
