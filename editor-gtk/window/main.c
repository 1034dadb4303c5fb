/* SPDX-License-Identifier: MIT
 *
 * main - the entry point of ladder-editor.
 */
#include "editor-gtk/window/app.h"

int main(int argc, char **argv)
{
	return app_run(argc, argv);
}
