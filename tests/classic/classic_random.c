/* SPDX-License-Identifier: MIT
 *
 * classic_random - writes one random ClassicLadder project and its script, to debug the
 * differential.
 *
 *   classic_random SEED NAME [odd]     writes NAME.clprj and NAME.script
 */
#include "tests/classic/random_project.h"

#include <stdio.h>
#include <stdlib.h>

static int write_text(const char *name, const char *end, const char *text)
{
	char path[1000];
	FILE *file;

	snprintf(path, sizeof(path), "%s%s", name, end);
	file = fopen(path, "w");
	if (!file || fputs(text, file) < 0 || fclose(file) != 0) {
		perror(path);
		return 1;
	}
	return 0;
}

int main(int argc, char **argv)
{
	struct random_texts texts;
	int status;

	if (argc < 3) {
		fprintf(stderr, "usage: classic_random SEED NAME [odd]\n");
		return 2;
	}
	if (!random_project(strtoull(argv[1], NULL, 10), argc > 3, &texts))
		return 1;
	status = write_text(argv[2], ".clprj", texts.project) |
		 write_text(argv[2], ".script", texts.script);
	free(texts.project);
	free(texts.script);
	return status;
}
