/* SPDX-License-Identifier: MIT
 *
 * options - reads the arguments by one table. A value follows `=` or is the next argument.
 */
#include "ladderd/options.h"

#include "engine/base/literal.h"

#include <stddef.h>
#include <string.h>

#define PERIOD_LEAST INT64_C(100000)      /* 100 us */
#define PERIOD_MOST  INT64_C(60000000000) /* 1 min  */

#ifdef RUNGBOARD_SMALL
#define HAS_PARSER 0
#else
#define HAS_PARSER 1
#endif

#ifndef RUNGBOARD_SMALL
#define VALUES_HELP \
"                   and of the quality of a value, as `%AIW0 77 stale`\n"
#define LINK_HELP \
"  --link SOCKET    let desks watch and change it (docs/online.md)\n" \
"  --serial TTY[,BAUD]  the same over a serial line; 115200 baud if none is given\n" \
"  --serial-role ROLE  what a desk there may do: view, oper or eng; default eng\n" \
"  --slots FOLDER   store the programs that desks download; FILE and MAP are only\n" \
"                   needed until the first one, and used again when they change\n" \
"  --full-scan      run the whole program in each scan, also what nothing has reached\n" \
"  --groups FILE    with --link: the groups, instead of /etc/group\n" \
"  --late N         with --link: N late scans in a row are an event of the log;\n" \
"                   1 to 1000, default 3\n" \
"  --record KB      with --link: memory for the record of the last scans, 0 to 65536;\n" \
"                   default 1024, 0: none (docs/record.md)\n"
#define LINK_ROWS \
	{ "--link",          TEXT,   AT(link),      0, 0 }, \
	{ "--serial",        TEXT,   AT(serial),    0, 0 }, \
	{ "--serial-role",   TEXT,   AT(serial_role), 0, 0 }, \
	{ "--slots",         TEXT,   AT(slots),     0, 0 }, \
	{ "--full-scan",     FLAG,   AT(full_scan), 0, 0 }, \
	{ "--groups",        TEXT,   AT(groups),    0, 0 }, \
	{ "--late",          NUMBER, AT(late),      1, 1000 }, \
	{ "--record",        NUMBER, AT(record_kb), 0, 65536 },
#elif defined(RUNGBOARD_SERIAL) /* a small board with a serial line alone */
#define VALUES_HELP
#define LINK_HELP \
"  --serial TTY[,BAUD]  let a desk watch and change it (docs/online.md); 115200 baud\n" \
"                   if none is given\n" \
"  --serial-role ROLE  what a desk there may do: view, oper or eng; default eng\n" \
"  --slots FOLDER   store the program that a desk downloads; it runs instead of FILE\n" \
"                   and MAP until they change\n"
#define LINK_ROWS \
	{ "--serial",        TEXT,   AT(serial),    0, 0 }, \
	{ "--serial-role",   TEXT,   AT(serial_role), 0, 0 }, \
	{ "--slots",         TEXT,   AT(slots),     0, 0 },
#else
#define VALUES_HELP
#define LINK_HELP
#define LINK_ROWS
#endif

const char *options_help(void)
{
	return
"Usage: ladderd FILE --io MAP [OPTION]...\n"
"Runs a ladder program on the pins of this machine, in the foreground.\n"
"\n"
"  FILE             a rung file, or a code image made by `ladder build`\n"
"  --io MAP         which pin each address uses (docs/boards.md)\n"
"  --period TIME    from one scan to the next, 100us to 1m; default: that of\n"
"                   the tasks of the program, or 10ms\n"
"  --watchdog N     FAULT after N late scans in a row, or one scan of N periods;\n"
"                   also for each task; 1 to 1000, default 10\n"
"  --rt PRIO        real-time priority 0 to 49, memory locked, and no idle state of\n"
"                   the processor that is slow to leave; 0: none of them\n"
"  --no-pm-qos      with --rt: leave the idle states as they are\n"
"  --retain FILE    keep VAR RETAIN in FILE when power fails (docs/boards.md)\n"
"  --retain-period TIME  time between writes of FILE, 10ms to 1h; default 10s\n"
"  --cold           start without the values in FILE\n"
LINK_HELP
"  --scans N        stop after N scans or at a FAULT, and print the status\n"
"  --check          load everything, open no line, print the memory needed\n"
"  --trace-io       print each change of an output to stderr, as `%QX0.0 1`\n"
VALUES_HELP
"  --attended       stop when standard input ends (for programs that start it)\n"
"  --help, --version\n"
"\n"
"Signals: TERM and INT stop it, USR1 prints the status, HUP resets a FAULT.\n"
"Outputs have their safe values before the first scan, in a FAULT, and after the\n"
"last scan. Exit status: 0 stopped; 1 an error in a file, a line that cannot be\n"
"used, or stopped in a FAULT; 2 wrong usage or a file that cannot be read.\n"
"\n"
"Example: ladderd garage.rung --io raspberry-pi.io --period 5ms --rt 40\n";
}

enum kind { FLAG, TEXT, NUMBER, TIME };

static const struct option_row {
	const char *name;
	enum kind kind;
	size_t at;             /* of the member in struct options            */
	int64_t least, most;   /* of NUMBER, and of TIME in ns               */
} rows[] = {
#define AT(member) offsetof(struct options, member)
	{ "--io",            TEXT,   AT(map),       0, 0 },
	{ "--period",        TIME,   AT(period_ns), PERIOD_LEAST, PERIOD_MOST },
	{ "--watchdog",      NUMBER, AT(watchdog),  1, 1000 },
	{ "--rt",            NUMBER, AT(priority),  0, 49 },
	{ "--no-pm-qos",     FLAG,   AT(no_pm_qos), 0, 0 },
	{ "--retain",        TEXT,   AT(retain.path), 0, 0 },
	{ "--retain-period", TIME,   AT(retain.period_ns), STORE_PERIOD_LEAST,
	  STORE_PERIOD_MOST },
LINK_ROWS
	{ "--cold",          FLAG,   AT(retain.cold), 0, 0 },
	{ "--scans",         NUMBER, AT(scans),     1, INT64_MAX },
	{ "--check",         FLAG,   AT(check),     0, 0 },
	{ "--trace-io",      FLAG,   AT(trace_io),  0, 0 },
	{ "--attended",      FLAG,   AT(attended),  0, 0 },
	{ "--help",          FLAG,   AT(help),      0, 0 },
	{ "--version",       FLAG,   AT(version),   0, 0 },
#undef AT
};

static bool parse_number(const char *text, int64_t *out)
{
	size_t digits = strspn(text, "0123456789");

	if (digits == 0 || digits > 18 || text[digits])
		return false;
	*out = 0;
	for (size_t i = 0; i < digits; i++)
		*out = *out * 10 + (text[i] - '0');
	return true;
}

/* False: the value is bad. */
static bool set_option(struct options *options, const struct option_row *row,
		       const char *value)
{
	char *at = (char *)options + row->at;
	int64_t number = 0;

	switch (row->kind) {
	case FLAG:
		*(bool *)at = true;
		return true;
	case TEXT:
		*(const char **)at = value;
		return *value || row->at == offsetof(struct options, map);
	case NUMBER:
		if (!parse_number(value, &number))
			return false;
		break;
	case TIME:
		if (!literal_parse_duration(value, strlen(value), &number))
			return false;
		break;
	}
	*(int64_t *)at = number;
	return number >= row->least && number <= row->most;
}

bool options_set(struct options *options, const char *name, const char *value)
{
	for (size_t k = 0; k < sizeof(rows) / sizeof(rows[0]); k++)
		if (strcmp(rows[k].name, name) == 0)
			return set_option(options, &rows[k], value);
	return false;
}

static bool wrong(struct options *options, const char *argument,
		  const char *why)
{
	options->wrong = argument;
	options->why = why;
	return false;
}

/* Reads the option argv[*i] and its value, which may be the next argument. */
static bool read_option(struct options *options, int *i, char **argv)
{
	const char *name = argv[*i];
	size_t len = strcspn(name, "=");

	for (size_t k = 0; k < sizeof(rows) / sizeof(rows[0]); k++) {
		const char *value = name[len] ? name + len + 1 : NULL;

		if (strlen(rows[k].name) != len ||
		    strncmp(rows[k].name, name, len) != 0)
			continue;
		if (rows[k].kind == FLAG && value)
			return wrong(options, name, "takes no value");
		if (rows[k].kind != FLAG && !value)
			value = argv[++*i];
		if (rows[k].kind != FLAG && !value)
			return wrong(options, name, "needs a value");
		if (!set_option(options, &rows[k], value))
			return wrong(options, name, rows[k].kind == TIME ?
				     "needs a time between its limits, such as 10ms" :
				     rows[k].kind == NUMBER ?
				     "needs a whole number between its limits" :
				     "needs a value");
		return true;
	}
	return wrong(options, name, "is not an option");
}

bool options_read(struct options *options, int argc, char **argv)
{
	bool only_files = false;

	memset(options, 0, sizeof(*options));
	options->retain.period_ns = INT64_C(10000000000);
	options->watchdog = 10;
	options->late = 3;
	options->groups = "/etc/group";
	options->record_kb = 1024;
	options->serial_role = "eng";
	for (int i = 1; i < argc; i++) {
		if (!only_files && strcmp(argv[i], "--") == 0)
			only_files = true;
		else if (!only_files && argv[i][0] == '-' && argv[i][1]) {
			if (!read_option(options, &i, argv))
				return false;
		} else if (options->file)
			return wrong(options, argv[i], "one FILE only");
		else
			options->file = argv[i];
	}
	/* A service without /etc/ladder/active gives both, empty. */
	if (options->file && !*options->file && options->map && !*options->map)
		options->file = options->map = NULL;
	if (options->help || options->version)
		return true;
	/* What does nothing until a desk brings a program is a rung file. */
	if (HAS_PARSER && !options->file && !options->map && options->slots &&
	    (options->link || options->serial))
		return true;
	if (!options->file)
		return wrong(options, "FILE", "is missing");
	return options->map || wrong(options, "--io MAP", "is missing");
}
