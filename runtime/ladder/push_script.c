/* SPDX-License-Identifier: MIT
 *
 * push_script - what `ladder push` runs on the board: POSIX sh, so that busybox
 * does it too.
 *
 * All stands between braces: a shell runs nothing of them before it has read the
 * last one, so that a script that was cut does nothing. `active` names what
 * ladderd runs; one rename replaces it, and before and after that rename it names
 * a folder that is whole. The folder of the program before is kept.
 */
#include "ladder/push.h"

static const char body[] =
"PATH=$PATH:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin\n"
"new=$1/$2\n"
"\n"
"give_up() { rm -rf \"$new\"; exit \"$1\"; }\n"
"\n"
"service() { # restart or status\n"
"	case $how,$1 in\n"
"	systemd,restart)\n"
"		# Three starts a minute are for crashes, not for pushes.\n"
"		$root systemctl reset-failed ladderd 2>/dev/null\n"
"		$root systemctl restart ladderd ;;\n"
"	systemd,status)\n"
"		$root systemctl kill -s USR1 ladderd &&\n"
"			sleep 1\n"
"		systemctl status --no-pager -n 15 -o cat ladderd ;;\n"
"	*)\n"
"		\"$how\" \"$1\" ;;\n"
"	esac\n"
"}\n"
"\n"
"umask 022\n"
"cd \"$1\" || exit 47\n"
"[ $(($(wc -c <\"$new/program.rungc\"))) -eq \"$3\" ] || give_up 44\n"
"[ $(($(wc -c <\"$new/board.io\"))) -eq \"$4\" ] || give_up 44\n"
"command -v ladderd >/dev/null || give_up 45\n"
"ladderd \"$new/program.rungc\" --io \"$new/board.io\" --check >/dev/null ||\n"
"	give_up 41\n"
"\n"
"root=\n"
"if [ -x ./service ]; then\n"
"	how=./service\n"
"elif systemctl cat ladderd.service >/dev/null 2>&1; then\n"
"	how=systemd\n"
"	[ \"$(id -u)\" = 0 ] ||\n"
"		! sudo -n -l systemctl restart ladderd >/dev/null 2>&1 ||\n"
"		root='sudo -n'\n"
"elif [ -x /etc/init.d/ladderd ]; then\n"
"	how=/etc/init.d/ladderd\n"
"elif how=$(command -v ladderd-run); then\n"
"	:\n"
"else\n"
"	give_up 46\n"
"fi\n"
"\n"
"if [ -f active ]; then\n"
"	cp active \"$new/before\" || give_up 47\n"
"fi\n"
"printf 'LADDERD_FILE=%s\\nLADDERD_MAP=%s\\n' \"$new/program.rungc\" \\\n"
"	\"$new/board.io\" >\"$new/active\" || give_up 47\n"
"sync\n"
"# From here on it goes through to its end, whether somebody listens or not.\n"
"trap '' HUP INT TERM PIPE\n"
"mv -f \"$new/active\" active || give_up 47\n"
"sync\n"
"if service restart >&2 && sleep 1 && service status >\"$new/status\"; then\n"
"	keep=$(sed -n 's|^LADDERD_FILE=.*/\\(push-[0-9a-f]*\\)/.*|\\1|p' \\\n"
"		\"$new/before\" 2>/dev/null)\n"
"	for old in push-*; do\n"
"		case $old in\n"
"		\"$2\" | \"$keep\") ;;\n"
"		*) rm -rf \"$old\" ;;\n"
"		esac\n"
"	done\n"
"	cat \"$new/status\"\n"
"	exit 0\n"
"fi\n"
"cat \"$new/status\" >&2\n"
"if [ -f \"$new/before\" ]; then\n"
"	cp \"$new/before\" \"$new/active\" && sync && mv -f \"$new/active\" active\n"
"else\n"
"	rm -f active\n"
"fi\n"
"sync\n"
"service restart >&2\n"
"sleep 1\n"
"service status >/dev/null && give_up 42\n"
"give_up 43\n";

void push_script(const struct push_names *names, const struct sink *out)
{
	sink_text(out, "{\nset -- ");
	sink_text(out, names->folder);
	sink_printf(out, " %s %zu %zu\n", names->name, names->program_bytes,
		    names->map_bytes);
	sink_text(out, body);
	sink_text(out, "}\n");
}
