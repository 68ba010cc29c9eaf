/* SPDX-License-Identifier: Apache-2.0
 * Deprecated: all of it is in pileus.h. Gone in 1.0.0; docs/migration.md. */
#include "pileus.h"
