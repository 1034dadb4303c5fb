/* SPDX-License-Identifier: MIT
 *
 * probe - is run by ladderd's unit instead of ladderd, and prints what the unit lets it do.
 *
 * check.py compares the lines with what it expects. A line is `WHAT: ok`, or `WHAT: ` and the error
 * of the kernel.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/personality.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

/* @result: of a system call, negative if it failed; anything that it opened stays open. */
static void tell(const char *what, long result)
{
	printf("%s: %s\n", what, result >= 0 ? "ok" : strerrorname_np(errno));
}

static void sockets(void)
{
	tell("socket AF_UNIX", socket(AF_UNIX, SOCK_STREAM, 0));
	tell("socket AF_INET", socket(AF_INET, SOCK_STREAM, 0));
	tell("socket AF_INET6", socket(AF_INET6, SOCK_STREAM, 0));
	tell("socket AF_NETLINK", socket(AF_NETLINK, SOCK_RAW, 0));
	tell("socket AF_PACKET", socket(AF_PACKET, SOCK_RAW, 0));
	tell("socket AF_VSOCK", socket(AF_VSOCK, SOCK_STREAM, 0));
}

static void calls(void)
{
	static char *const words[] = { "true", NULL };
	struct timeval now;
	void *map = mmap(NULL, 4096, PROT_READ | PROT_WRITE | PROT_EXEC,
			 MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

	gettimeofday(&now, NULL);
	tell("memory to write and run", map == MAP_FAILED ? -1 : 0);
	tell("ptrace", ptrace(PTRACE_TRACEME, 0, NULL, NULL));
	tell("mount", mount("none", "/tmp", "tmpfs", 0, NULL));
	tell("unshare", unshare(CLONE_NEWUSER));
	tell("personality", personality(ADDR_NO_RANDOMIZE));
	tell("settimeofday", settimeofday(&now, NULL));
	tell("setuid 0", setuid(0));
	tell("chmod u+s", fchmod(open("/tmp/probe", O_CREAT | O_WRONLY, 0700), 04700));
	tell("mknod", mknod("/tmp/probe-device", S_IFCHR | 0600, makedev(10, 200)));
	tell("chroot", chroot("/tmp"));
	tell("init_module", syscall(SYS_init_module, "", 0, ""));
	tell("kexec_load", syscall(SYS_kexec_load, 0, 0, NULL, 0));
	tell("bpf", syscall(SYS_bpf, 0, NULL, 0));
	tell("perf_event_open", syscall(SYS_perf_event_open, NULL, 0, -1, -1, 0));
	tell("io_uring_setup", syscall(SYS_io_uring_setup, 1, NULL));
	tell("kill 1", kill(1, 0));
	/* The last one: if it succeeds, the lines after it are missing. */
	tell("execve", execv("/usr/bin/true", words));
}

/* Folders that it can write, and devices that it can open; their contents are not followed into
 * /proc and /sys. */
static int see(const char *path, const struct stat *at, int kind, struct FTW *place)
{
	(void)place;
	if (kind == FTW_D && (strcmp(path, "/proc") == 0 || strcmp(path, "/sys") == 0))
		return FTW_SKIP_SUBTREE;
	if (kind == FTW_D && access(path, W_OK) == 0)
		printf("writes %s\n", path);
	if (kind == FTW_F && (S_ISCHR(at->st_mode) || S_ISBLK(at->st_mode))) {
		const int fd = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK);

		if (fd >= 0)
			printf("opens %s\n", path);
		else if (strncmp(path, "/dev/probe-", 11) == 0)
			tell(path, -1);
		if (fd >= 0)
			close(fd);
	}
	return FTW_CONTINUE;
}

static void processes(void)
{
	DIR *proc = opendir("/proc");
	const struct dirent *entry;
	int count = 0;

	while (proc && (entry = readdir(proc)))
		count += entry->d_name[0] >= '1' && entry->d_name[0] <= '9';
	printf("processes: %d\n", count);
	tell("/proc/meminfo", open("/proc/meminfo", O_RDONLY));
}

static void copy(const char *path)
{
	FILE *file = fopen(path, "r");
	char line[512];

	while (file && fgets(line, sizeof(line), file))
		fputs(line, stdout);
}

/* Tells systemd that the service has started: all lines have been printed. */
static void started(void)
{
	struct sockaddr_un at = { .sun_family = AF_UNIX };
	const char *name = getenv("NOTIFY_SOCKET");
	const int fd = socket(AF_UNIX, SOCK_DGRAM, 0);

	fflush(stdout);
	if (!name || strlen(name) >= sizeof(at.sun_path))
		return;
	memcpy(at.sun_path, name, strlen(name));
	if (at.sun_path[0] == '@')
		at.sun_path[0] = '\0';
	sendto(fd, "READY=1", 7, MSG_NOSIGNAL, (const void *)&at,
	       (socklen_t)(sizeof(at.sun_family) + strlen(name)));
}

int main(void)
{
	copy("/proc/self/status");
	copy("/proc/self/net/dev");
	sockets();
	nftw("/", see, 16, FTW_PHYS | FTW_ACTIONRETVAL);
	processes();
	calls();
	started();
	pause();
	return 0;
}
