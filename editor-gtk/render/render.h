/* SPDX-License-Identifier: MIT
 *
 * render - pictures of a project from the command line, with no display.
 */
#ifndef EDITOR_RENDER_H
#define EDITOR_RENDER_H

/**
 * render_main - all of `ladder-editor --render …`; call it before GTK is started
 *
 * Returns the exit status: 0; 1 when the file has errors that leave nothing to draw;
 * 2: wrong usage, or a file that cannot be read or written. What is wrong is said on
 * stderr.
 */
int render_main(int argc, char **argv);

#endif
