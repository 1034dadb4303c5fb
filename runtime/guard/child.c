/* SPDX-License-Identifier: MIT
 *
 * child - vfork() and exec with an environment in a table of fixed size.
 */
#define _GNU_SOURCE
#include "guard/child.h"

#include "guard/say.h"
#include "guard/text.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <unistd.h>

#ifndef SYS_pidfd_open
#define SYS_pidfd_open 434
#endif
#define SEALS     (F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL)
#define VARIABLES 256

extern char **environ;

static bool is_variable(const char *text, const char *name)
{
	const size_t len = strlen(name);

	return strncmp(text, name, len) == 0 && text[len] == '=';
}

/* The service manager speaks with the guard alone. */
static bool make_environment(char **table, char *ours)
{
	static const char *const without[] = {
		"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID", GUARD_VARIABLE,
	};
	size_t count = 0;

	for (char **from = environ; *from; from++) {
		bool drop = false;

		for (size_t i = 0; i < sizeof(without) / sizeof(without[0]); i++)
			drop = drop || is_variable(*from, without[i]);
		if (drop)
			continue;
		if (count == VARIABLES - 2)
			return false;
		table[count++] = *from;
	}
	table[count++] = ours;
	table[count] = NULL;
	return true;
}

/* With its size sealed: a ladderd that cut it would end the guard by SIGBUS. */
void child_page(struct child *child)
{
	const int fd = (int)syscall(SYS_memfd_create, "ladder-guard", MFD_CLOEXEC | MFD_ALLOW_SEALING);
	void *page = MAP_FAILED;

	if (fd >= 0 && ftruncate(fd, sizeof(*child->page)) == 0 && fcntl(fd, F_ADD_SEALS, SEALS) == 0)
		page = mmap(NULL, sizeof(*child->page), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
	child->page = page != MAP_FAILED ? page : NULL;
	child->page_fd = child->page ? fd : -1;
	if (!child->page)
		text_say("no memory to share with ladderd: %s; a scan that "
			"hangs is found by its heartbeat", strerror(errno));
}

/* After vfork(): system calls only. */
static void become(char **argv, int socket, int page, pid_t guard)
{
	sigset_t own;

	prctl(PR_SET_PDEATHSIG, SIGTERM);
	if (getppid() != guard)
		_exit(0);
	fcntl(socket, F_SETFD, 0);
	if (page >= 0)
		fcntl(page, F_SETFD, 0);
	sigemptyset(&own);
	sigaddset(&own, SIGCHLD);
	sigprocmask(SIG_UNBLOCK, &own, NULL);
	execvp(argv[0], argv);
	_exit(CHILD_NO_PROGRAM);
}

bool child_start(struct child *child, char **argv, int heartbeat_ms, bool stopped,
		 unsigned count, int how)
{
	static char *table[VARIABLES];
	static char ours[96];
	const pid_t guard = getpid();
	char **before = environ;
	int pair[2];
	pid_t pid;

	if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0) {
		text_say("no socket pair: %s", strerror(errno));
		return false;
	}
	if (child->page)
		memset(child->page, 0, sizeof(*child->page));
	text_print(ours, sizeof(ours), GUARD_VARIABLE "=%d %d %d %u %d %d", pair[1], heartbeat_ms, stopped,
		 count, how, child->page_fd);
	if (!make_environment(table, ours)) {
		text_say("more than %d variables in the environment; start it with fewer, for example with "
			 "env -i or from systemd", VARIABLES - 2);
		close(pair[0]);
		close(pair[1]);
		return false;
	}
	environ = table;
	pid = vfork();
	if (pid == 0)
		become(argv, pair[1], child->page_fd, guard);
	environ = before;
	close(pair[1]);
	if (pid < 0) {
		text_say("no process: %s", strerror(errno));
		close(pair[0]);
		return false;
	}
	child->pid = pid;
	child->socket = pair[0];
	child->pidfd = (int)syscall(SYS_pidfd_open, pid, 0);
	return true;
}

bool child_ended(struct child *child)
{
	if (child->pid == 0 || waitpid(child->pid, &child->status, WNOHANG) != child->pid)
		return false;
	child->pid = 0;
	return true;
}

void child_close(struct child *child)
{
	if (child->pidfd >= 0)
		close(child->pidfd);
	close(child->socket);
	child->pidfd = child->socket = -1;
}
