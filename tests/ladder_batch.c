/* SPDX-License-Identifier: MIT
 *
 * ladder_batch - many commands of `ladder` in one process, for emulators.
 *
 * An emulator translates a program anew each time it starts. This program starts once and
 * calls ladder's own main() for each command. A command is a line of standard input: fields
 * with tabs between them, which are the folder of the command, the files that take standard
 * output and standard error, then its words. The answer is a line with the exit status. It
 * is a tool of tests/golden.t and judges nothing.
 */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int ladder_main(int argc, char **argv);
#define main ladder_main
#include "runtime/ladder/main.c"
#undef main

enum { FIELDS_MAX = 16, FIRST_WORD = 3 };

static bool redirect(int fd, const char *path)
{
	int file = open(path, O_WRONLY | O_TRUNC);
	bool good = file >= 0 && dup2(file, fd) == fd;

	if (file >= 0)
		close(file);
	return good;
}

static int run(char **field, int count)
{
	char name[] = "ladder", *argv[FIELDS_MAX] = { name };
	int argc = 1;

	for (int i = FIRST_WORD; i < count; i++)
		argv[argc++] = field[i];
	if (chdir(field[0]) || !redirect(STDOUT_FILENO, field[1]) || !redirect(STDERR_FILENO, field[2]))
		return -1;
	return ladder_main(argc, argv);
}

static int split(char *line, char **field)
{
	int count = 0;

	line[strcspn(line, "\n")] = '\0';
	while (count < FIELDS_MAX - 1) {
		size_t length = strcspn(line, "\t");
		bool last = line[length] == '\0';

		field[count++] = line;
		line[length] = '\0';
		if (last)
			break;
		line += length + 1;
	}
	return count;
}

int main(void)
{
	FILE *answers = fdopen(dup(STDOUT_FILENO), "w");
	char *line = NULL, *field[FIELDS_MAX];
	size_t size = 0;

	if (!answers)
		return 1;
	while (getline(&line, &size, stdin) > 0) {
		int count = split(line, field);

		fprintf(answers, "%d\n", count > FIRST_WORD ? run(field, count) : -1);
		fflush(answers);
	}
	free(line);
	return fclose(answers) ? 1 : 0;
}
