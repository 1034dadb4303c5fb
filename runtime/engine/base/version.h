/* SPDX-License-Identifier: MIT
 *
 * version - of the project, for all its programs.
 */
#ifndef BASE_VERSION_H
#define BASE_VERSION_H

#define LADDER_VERSION "0.1.0"

#endif
