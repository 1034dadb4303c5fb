/* SPDX-License-Identifier: MIT
 *
 * test_serial - a desk at the serial line of a small board (LINK=serial), without threads: the
 * terminal's other end is the desk itself.
 */
#define _GNU_SOURCE /* posix_openpt(), cfmakeraw() */
#include "tests/targets/guest/panel.h"

#include "online/desk.h"
#include "online/send.h"
#include "online/status.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#define BAUD 115200

/* Allocated only where it is used: without an MMU a program's static data are one piece of memory,
 * which a board of 8 MiB does not have a second time. */
static struct desk *desk;
static struct board_status status;

/* Returns the desk's end; -1: this kernel has no terminals. */
static int terminal_open(char *path, size_t size)
{
	struct termios mode;
	const char *name;
	int fd, slave;

	mkdir("/dev/pts", 0755);
	mount("devpts", "/dev/pts", "devpts", 0, "ptmxmode=0666");
	fd = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
	if (fd < 0 || unlockpt(fd) != 0 || (name = ptsname(fd)) == NULL)
		return -1;
	snprintf(path, size, "%s", name);
	slave = open(path, O_RDWR | O_NOCTTY); /* stays open, so the line is never hung up */
	if (slave < 0 || tcgetattr(slave, &mode) != 0)
		return -1;
	cfmakeraw(&mode);
	return tcsetattr(slave, TCSANOW, &mode) == 0 ? fd : -1;
}

static bool begin(int fd)
{
	const struct stream stream = { .fd = fd, .baud = BAUD };
	const enum desk_end end = desk_open(desk, &stream, "guest");

	if (end != DESK_GOOD)
		note("hello ended with %d, refusal %u", (int)end, (unsigned)desk->refusal);
	return end == DESK_GOOD;
}

static bool call(struct wire_writer *out, struct wire_reader *in)
{
	const uint8_t service = desk->out[4];
	const enum desk_end end = desk_call(desk, out, in);

	if (end != DESK_GOOD)
		note("service %u ended with %d, refusal %u %s", service, (int)end,
		     (unsigned)desk->refusal, desk->detail);
	return end == DESK_GOOD;
}

static bool learn(void)
{
	struct wire_writer out = desk_ask(desk, SERVICE_STATUS);
	struct wire_reader in;

	if (!call(&out, &in))
		return false;
	status_take(&in, &status);
	return !in.failed;
}

static struct wire_writer change(enum service service)
{
	struct wire_writer out = desk_ask(desk, service);
	struct expect expect = { .mode = EXPECT_ANY };

	memcpy(expect.program, status.program, sizeof(expect.program));
	wire_put_expect(&out, &expect);
	return out;
}

static bool force(bool on)
{
	struct wire_writer out = change(on ? SERVICE_FORCE : SERVICE_UNFORCE);
	struct wire_reader in;

	wire_put_u16(&out, on);
	if (on) {
		wire_put_name(&out, "%QX0.0");
		wire_put_u8(&out, IEC_BOOL);
		wire_put_u8(&out, 1);
	}
	return call(&out, &in);
}

static bool with_byte(enum service service, uint8_t byte)
{
	struct wire_writer out = change(service);
	struct wire_reader in;

	wire_put_u8(&out, byte);
	return call(&out, &in);
}

static bool send_other(void)
{
	static char bytes[TEXT_BYTES];
	struct stored stored = { .bytes = (const uint8_t *)bytes };
	struct sent sent = { .go_on = NULL };
	const long len = file_take(file_case("other.rungc"), bytes, sizeof(bytes));
	struct wire_writer out;
	struct wire_reader in;
	enum desk_end end;

	if (len <= 0 || (size_t)len + sizeof(PANEL_PLAIN) > sizeof(bytes))
		return false;
	memcpy(bytes + len, PANEL_PLAIN, sizeof(PANEL_PLAIN) - 1);
	stored.len[STORED_IMAGE] = (uint32_t)len;
	stored.len[STORED_MAP] = sizeof(PANEL_PLAIN) - 1;
	end = send_program(desk, &stored, true, &sent);
	if (end != DESK_GOOD) {
		note("the download ended with %d, refusal %u", (int)end, (unsigned)desk->refusal);
		return false;
	}
	out = desk_ask(desk, SERVICE_VERIFY);
	return call(&out, &in);
}

static void use(int fd)
{
	check(begin(fd) && desk->role == ROLE_ENG && strcmp(desk->board, "panel") == 0,
	      "a desk is heard");
	check(learn() && status.mode == 1 && status.lines == 8, "status");
	check(force(true) && panel_shows(0xd) && learn() && status.forces == 1,
	      "a forced output has its level");
	check(force(false) && panel_shows(0xc), "released, the program drives it again");
	check(with_byte(SERVICE_MODE, MODE_STOP) && panel_shows(0), "stopped, outputs are safe");
	check(with_byte(SERVICE_MODE, MODE_WARM) && panel_shows(0xc), "it runs again");
	check(with_byte(SERVICE_MODE, MODE_STOP) && send_other() &&
	      with_byte(SERVICE_COMMIT, COMMIT_RESTART) && panel_shows(0x2),
	      "another program drives the lines");
	check(begin(fd) && learn() && status.mode == 1 && status.late == 0,
	      "a desk is heard again");
	serial_end(&desk->serial);
}

void test_serial(void)
{
	static char slots[PATH_MOST], slot[PATH_MOST + 8], line[48], tty[64];
	struct child child;
	int fd;

	if (!guest.small)
		return; /* test_link() */
	if (strcmp(guest.word, "serial") != 0) {
		skip("this ladderd was built without LINK=serial", "a desk at a serial line");
		return;
	}
	fd = terminal_open(line, sizeof(line));
	if (fd < 0) {
		skip("this kernel has no terminals", "a desk at a serial line");
		return;
	}
	snprintf(slots, sizeof(slots), "%s/slots", guest.work);
	snprintf(tty, sizeof(tty), "%s,%d", line, BAUD);
	mkdir(slots, 0755);
	panel_up(-1);
	ladderd_start(&child, panel_image(), file_text("serial.io", PANEL_PLAIN), "--slots", slots,
		      "--serial", tty, NULL);
	desk = calloc(1, sizeof(*desk));
	if (check(desk && child_ready() != 0 && panel_shows(0xc), "runs with a serial line"))
		use(fd);
	free(desk);
	check(child_stop(&child) == 0, "ends");
	panel_down();
	snprintf(slot, sizeof(slot), "%s/prog.A", slots);
	check(unlink(slot) == 0 && rmdir(slots) == 0, "the program was stored");
}
