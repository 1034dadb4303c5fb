/* SPDX-License-Identifier: MIT
 *
 * installed - finds files and programs of this package, wherever it was built or installed.
 */
#ifndef EDITOR_INSTALLED_H
#define EDITOR_INSTALLED_H

#include <glib.h>

/**
 * installed_folder - a folder of this program
 * @built:     its name beside the program in a build
 * @installed: below share/ of where the program is in bin/
 *
 * A file of that name is not accepted: /usr/bin has a program `locale`.
 * Owns: the caller, g_free().   Fails: NULL: there is none.
 */
char *installed_folder(const char *built, const char *installed);
/** installed_program - another program: beside this one, else in PATH. As installed_folder. */
char *installed_program(const char *name);
#endif
