/* SPDX-License-Identifier: MIT
 *
 * main - ladder-editor begins here: pictures are render.c's, everything else app.c's.
 */
#include "editor-gtk/app.h"
#include "editor-gtk/render.h"

#include <string.h>

int main(int argc, char **argv)
{
	for (int i = 1; i < argc; i++)
		if (strcmp(argv[i], "--render") == 0)
			return render_main(argc, argv);
	return app_run(argc, argv);
}
