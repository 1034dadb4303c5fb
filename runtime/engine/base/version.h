/* SPDX-License-Identifier: MIT
 *
 * version - the version of the project, for all programs.
 */
#ifndef BASE_VERSION_H
#define BASE_VERSION_H

#define LADDER_VERSION "0.1.0"

#endif
