/* SPDX-License-Identifier: MIT */
/*
 * init - the first process of every guest, with an MMU and without: mounts what a
 * test needs, loads /modules in the order of their names, runs the commands in /cmd
 * one after the other and switches the machine off. In /cmd each argument ends with
 * NUL and each command with an empty argument. What a command prints stands between
 * a line "BEGIN command" and a line "RC=status"; "END" comes last. A key on the
 * console ends the command that runs, with SIGTERM.
 *
 * It never forks (no-MMU) and knows nothing of the tests.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

enum { TEXT = 4096, ARGS = 64 };

#ifdef __arm__
/* Some boards have no power switch: semihosting's SYS_EXIT ends their emulator. Where
 * nobody listens to it, a large ARM asks the kernel for its process number instead. */
#if __ARM_ARCH_PROFILE == 'M'
#define CALL "bkpt 0xab"
#elif defined(__thumb__)
#define CALL "svc 0xab"
#else
#define CALL "svc 0x123456"
#endif
static void exit_emulator(void)
{
	register int call __asm__("r0") = 0x18;
	register int reason __asm__("r1") = 0x20026;
	register int otherwise __asm__("r7") = SYS_getpid;

	__asm__ volatile(CALL : "+r"(call)
			 : "r"(reason), "r"(otherwise) : "memory");
}
#else
static void exit_emulator(void)
{
}
#endif

static void switch_off(void)
{
	exit_emulator();
	reboot(RB_POWER_OFF);
}

static void attach(const char *type, const char *folder)
{
	mkdir(folder, 0755);
	if (mount(type, folder, type, 0, NULL) && errno != EBUSY)
		dprintf(1, "# init: mount %s: %s\n", folder, strerror(errno));
}

static void load_modules(void)
{
	struct dirent **found;
	int count = scandir("/modules", &found, NULL, alphasort);
	char path[320];

	for (int i = 0; i < count; i++) {
		if (found[i]->d_name[0] == '.')
			continue;
		snprintf(path, sizeof path, "/modules/%s", found[i]->d_name);
		int fd = open(path, O_RDONLY | O_CLOEXEC);
		if (syscall(SYS_finit_module, fd, "", 0))
			dprintf(1, "# init: %s: %s\n", path, strerror(errno));
		close(fd);
	}
}

static volatile sig_atomic_t running;

static void on_key(int number)
{
	(void)number;
	if (running > 0)
		kill(running, SIGTERM);
}

/* Output without CR; a signal for each key. */
static void set_terminal(void)
{
	struct termios terminal;
	struct sigaction key = { .sa_handler = on_key };

	if (!tcgetattr(1, &terminal)) {
		terminal.c_oflag &= ~(tcflag_t)OPOST;
		terminal.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
		tcsetattr(1, TCSANOW, &terminal);
	}
	sigaction(SIGIO, &key, NULL);
	fcntl(0, F_SETOWN, getpid());
	fcntl(0, F_SETFL, O_RDWR | O_ASYNC);
}

static int run(char **argv)
{
	static char *envp[] = { "PATH=/", "HOME=/", "TMPDIR=/tmp", NULL };
	int status = 0;
	pid_t child, gone;
	int wrong = posix_spawn(&child, argv[0], NULL, NULL, argv, envp);

	if (wrong) {
		dprintf(1, "# init: %s: %s\n", argv[0], strerror(wrong));
		return 127;
	}
	running = child;
	/* Orphans come here, too. */
	do
		gone = wait(&status);
	while (gone != child && (gone >= 0 || errno == EINTR));
	running = 0;
	tcflush(0, TCIFLUSH);
	return WIFSIGNALED(status) ? 128 + WTERMSIG(status)
				   : WEXITSTATUS(status);
}

static void run_commands(void)
{
	static char text[TEXT], *argv[ARGS];
	int fd = open("/cmd", O_RDONLY | O_CLOEXEC);
	ssize_t len = read(fd, text, sizeof text - 1);
	int count = 0;

	close(fd);
	for (ssize_t i = 0; i < len; i += (ssize_t)strlen(text + i) + 1) {
		if (text[i] && count < ARGS - 1) {
			argv[count++] = text + i;
			continue;
		}
		argv[count] = NULL;
		dprintf(1, "\nBEGIN %s\n", argv[0]);
		dprintf(1, "\nRC=%d\n", run(argv));
		count = 0;
	}
}

/* A board without a power switch waits here until its emulator is ended. */
int main(void)
{
	attach("proc", "/proc");
	attach("sysfs", "/sys");
	attach("devtmpfs", "/dev");
	set_terminal();
	load_modules();
	attach("configfs", "/sys/kernel/config");
	mkdir("/tmp", 01777);
	chmod("/tmp", 01777);
	run_commands();
	dprintf(1, "\nEND\n");
	sync();
	tcdrain(1);
	switch_off();
	for (;;)
		pause();
}
