/* SPDX-License-Identifier: MIT
 *
 * secret - reads byte by byte, so that no buffer of stdio keeps it.
 */
#include "ladder/secret.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

void secret_wipe(void *bytes, size_t len)
{
	volatile char *at = bytes;

	while (len--)
		*at++ = 0;
}

/* A line without its end. Fails: false: nothing, too long, or a control character. */
static bool read_line(int fd, char *out)
{
	size_t len = 0;
	bool good = true;
	char byte;

	while (read(fd, &byte, 1) == 1 && byte != '\n') {
		if (len + 1 == SECRET_MOST || (unsigned char)byte < ' ')
			good = false;
		else
			out[len++] = byte;
	}
	out[len] = '\0';
	return good && len;
}

/* Signals of keys are off, too: the terminal must not stay without echo. */
static bool ask(const char *question, char *out)
{
	const int fd = open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY);
	struct termios before, quiet;
	bool good = false;

	if (fd < 0)
		return false;
	if (tcgetattr(fd, &before) == 0) {
		quiet = before;
		quiet.c_lflag &= ~(tcflag_t)(ECHO | ISIG);
		/* First, so that nothing typed after the question is shown or lost. */
		if (tcsetattr(fd, TCSAFLUSH, &quiet) == 0) {
			dprintf(fd, "%s: ", question);
			good = read_line(fd, out);
			tcsetattr(fd, TCSAFLUSH, &before);
		}
		dprintf(fd, "\n");
	}
	close(fd);
	return good;
}

enum status secret_read(const struct call *call, const char *question, char *out)
{
	const char *given = call_option(call, "--password-fd");
	char *end;
	long fd;

	if (!given)
		return ask(question, out) ? STATUS_GOOD :
		       report_usage(call, "no password: type one at a terminal, or --password-fd");
	fd = strtol(given, &end, 10);
	if (*end || fd < 0 || fd > 1023)
		return report_usage(call, "--password-fd needs a number");
	return read_line((int)fd, out) ? STATUS_GOOD :
	       report_usage(call, "--password-fd: there is no line with a password");
}
