/* SPDX-License-Identifier: MIT
 *
 * main - the entry point of ladder-editor.
 */
#include "editor-gtk/online/ssh_ask.h"
#include "editor-gtk/window/app.h"

int main(int argc, char **argv)
{
	return ssh_ask_is_main() ? ssh_ask_main(argc, argv) : app_run(argc, argv);
}
