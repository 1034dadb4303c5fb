/* SPDX-License-Identifier: MIT
 *
 * port - speeds and modes of a serial line.
 */
#define _DEFAULT_SOURCE /* cfmakeraw(), flock() */
#include "online/port.h"
#include "online/serial.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

static const struct speed {
	uint32_t baud;
	speed_t code;
} speeds[] = {
	{ 1200, B1200 }, { 2400, B2400 }, { 4800, B4800 }, { 9600, B9600 }, { 19200, B19200 },
	{ 38400, B38400 }, { 57600, B57600 }, { 115200, B115200 }, { 230400, B230400 },
	{ 460800, B460800 }, { 921600, B921600 },
};

static const struct speed *find_speed(const char *digits)
{
	uint32_t baud = 0;

	for (; *digits >= '0' && *digits <= '9' && baud < 1000000; digits++)
		baud = 10 * baud + (uint32_t)(*digits - '0');
	for (size_t i = 0; !*digits && i < sizeof(speeds) / sizeof(speeds[0]); i++)
		if (speeds[i].baud == baud)
			return &speeds[i];
	return NULL;
}

static int make_raw(int fd, speed_t code)
{
	struct termios mode;

	if (flock(fd, LOCK_EX | LOCK_NB) != 0)
		return errno == EWOULDBLOCK ? -EBUSY : -errno;
	if (tcgetattr(fd, &mode) != 0)
		return -errno;
	cfmakeraw(&mode);
	cfsetispeed(&mode, code);
	cfsetospeed(&mode, code);
	mode.c_cflag |= CLOCAL | CREAD;
	mode.c_cflag &= ~(tcflag_t)CSTOPB;
	if (tcsetattr(fd, TCSANOW, &mode) != 0)
		return -errno;
	tcflush(fd, TCIFLUSH);
	return 0;
}

const char *port_why(int error)
{
	return error == -EINVAL ? "this is no speed of a serial line; try 115200" :
	       error == -EBUSY ? "another program or window uses it" :
	       error == -ENOTTY ? "this is no serial line" : strerror(-error);
}

int port_open(const char *text, uint32_t *baud)
{
	const char *comma = strrchr(text, ',');
	const struct speed *speed = find_speed(comma ? comma + 1 : "115200");
	const size_t len = comma ? (size_t)(comma - text) : strlen(text);
	char path[256];
	int fd, error;

	if (!speed)
		return -EINVAL;
	if (len >= sizeof(path))
		return -ENAMETOOLONG;
	memcpy(path, text, len);
	path[len] = '\0';
	fd = open(path, O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
	if (fd < 0)
		return -errno;
	error = make_raw(fd, speed->code);
	if (error) {
		close(fd);
		return error;
	}
	*baud = speed->baud;
	return fd;
}
