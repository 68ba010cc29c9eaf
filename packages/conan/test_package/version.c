/* SPDX-License-Identifier: Apache-2.0
 * Prints the version of the library that is linked. */
#include <pileus/pileus.h>
#include <stdio.h>

int main(void) {
    return puts(pileus_version()) < 0;
}
