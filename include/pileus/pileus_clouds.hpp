// SPDX-License-Identifier: Apache-2.0
// Deprecated: all of it is in pileus.hpp. For one version more; docs/migration.md.
#include "pileus.hpp"
