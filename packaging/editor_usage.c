/* SPDX-License-Identifier: MIT
 *
 * editor_usage - ladder-editor without its window: prints what `ladder-editor --man` prints.
 *
 * The build makes the man page with it, on the machine that builds, whatever machine the editor is
 * for.
 */
#include "editor-gtk/window/usage.h"

int main(int argc, char **argv)
{
	int status;

	return usage_main(argc, argv, &status) ? status : 2;
}
