/* SPDX-License-Identifier: MIT
 *
 * hold - stops a ladderd in the middle of a scan, or between requesting its lines and its
 * first scan, to read the lines at this moment.
 *
 * It steps from system call to system call with ptrace and asks after each. So the place is
 * exact, whatever the scheduler does. It reads no register, so it works on every processor.
 */
#define _GNU_SOURCE /* PTRACE_SEIZE */

#include "tests/targets/guest/child.h"

#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#define STEPS 20000
#define SYSCALL_STOP (SIGTRAP | 0x80)

/* Waits for the next stop. Returns the signal to pass on, or -1: it ended. */
static int next_stop(struct child *child)
{
	int signal_number;

	if (waitpid(child->pid, &child->status, __WALL) != child->pid)
		give_up("waitpid");
	if (!WIFSTOPPED(child->status)) {
		child->ended = true;
		child->traced = false;
		return -1;
	}
	signal_number = WSTOPSIG(child->status);
	if (signal_number == SYSCALL_STOP || signal_number == SIGTRAP ||
	    signal_number == SIGSTOP || child->status >> 16)
		return 0;
	return signal_number;
}

static bool go_on(struct child *child, int signal_number)
{
	return ptrace(PTRACE_SYSCALL, child->pid, NULL,
		      (void *)(intptr_t)signal_number) == 0;
}

static bool seize(struct child *child)
{
	if (ptrace(PTRACE_SEIZE, child->pid, NULL,
		   (void *)(intptr_t)PTRACE_O_TRACESYSGOOD) != 0)
		return false;
	child->traced = true;
	return ptrace(PTRACE_INTERRUPT, child->pid, NULL, NULL) == 0 &&
	       next_stop(child) >= 0;
}

bool child_start_held(struct child *child, const char *const *argv)
{
	const char *held[16] = { guest.self, "--held" };

	for (int i = 0; argv[i] && i < 13; i++)
		held[2 + i] = argv[i];
	child_start(child, 0, held);
	child->traced = true;
	return next_stop(child) >= 0 &&
	       ptrace(PTRACE_SETOPTIONS, child->pid, NULL,
		      (void *)(intptr_t)PTRACE_O_TRACESYSGOOD) == 0;
}

bool child_hold(struct child *child, bool (*there)(void *context),
		void *context)
{
	int signal_number = 0;

	if (!child->traced && !seize(child))
		return false;
	for (int i = 0; i < STEPS; i++) {
		if (there(context))
			return true;
		if (!go_on(child, signal_number))
			give_up("PTRACE_SYSCALL");
		signal_number = next_stop(child);
		if (signal_number < 0)
			return false;
	}
	child_let_go(child);
	return false;
}

void child_let_go(struct child *child)
{
	if (child->traced)
		ptrace(PTRACE_DETACH, child->pid, NULL, NULL);
	child->traced = false;
}
