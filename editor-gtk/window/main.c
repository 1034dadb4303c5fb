/* SPDX-License-Identifier: MIT
 *
 * main - ladder-editor begins here; everything else is app.c's.
 */
#include "editor-gtk/window/app.h"

int main(int argc, char **argv)
{
	return app_run(argc, argv);
}
