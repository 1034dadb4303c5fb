/* SPDX-License-Identifier: MIT
 *
 * classic_trace - runs a script on a ClassicLadder project with the second evaluator.
 *
 *   classic_trace [--faithful] [--changes] [--upstream] PROJECT SCRIPT
 *
 * Prints a trace in the form of those recorded from ClassicLadder. --upstream: runs a LinuxCNC
 * project as upstream does, which made the recorded traces.
 */
#include "tests/classic/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv)
{
	bool faithful = false, changes = false, upstream = false;
	const char *file[2] = { NULL, NULL };
	struct loaded loaded;
	char *script;
	int files = 0, status = 0;

	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--faithful") == 0)
			faithful = true;
		else if (strcmp(argv[i], "--changes") == 0)
			changes = true;
		else if (strcmp(argv[i], "--upstream") == 0)
			upstream = true;
		else if (files < 2)
			file[files++] = argv[i];
	}
	if (files != 2) {
		fprintf(stderr, "usage: classic_trace [--faithful] [--changes] [--upstream] PROJECT SCRIPT\n");
		return 2;
	}
	if (!load_project(&loaded, file[0]))
		return 1;
	if (upstream)
		loaded.project->dialect = CLASSIC_UPSTREAM;
	script = load_text(file[1]);
	if (!script || !run_script(loaded.project, faithful, changes, script, stdout))
		status = 1;
	free(script);
	unload_project(&loaded);
	return status;
}
