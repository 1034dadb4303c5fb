/* SPDX-License-Identifier: MIT
 *
 * options - reads the arguments from one table. A value may stand behind `=` or
 * be the next argument.
 */
#include "ladderd/options.h"

#include "engine/base/literal.h"

#include <stdio.h>
#include <string.h>

#define PERIOD_LEAST INT64_C(100000)      /* 100 us */
#define PERIOD_MOST  INT64_C(60000000000) /* 1 min  */

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
"  --rt PRIO        real-time priority 1 to 49, and memory locked\n"
"  --retain FILE    keep VAR RETAIN in FILE when power fails (docs/boards.md)\n"
"  --retain-period TIME  time between writes of FILE, 10ms to 1h; default 10s\n"
"  --cold           start without the values in FILE\n"
"  --scans N        stop after N scans or at a FAULT, and print the status\n"
"  --check          load everything, open no line, print the memory needed\n"
"  --trace-io       print each change of an output to stderr, as `%QX0.0 1`\n"
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

static bool read_number(const char *text, uint64_t least, uint64_t most,
			uint64_t *out)
{
	uint64_t value = 0;
	size_t digits = strspn(text, "0123456789");

	if (digits == 0 || digits > 18 || text[digits])
		return false;
	for (size_t i = 0; i < digits; i++)
		value = value * 10 + (uint64_t)(text[i] - '0');
	*out = value;
	return value >= least && value <= most;
}

static bool set_file_map(struct options *options, const char *value)
{
	options->map = value;
	return *value != 0;
}

static bool read_time(const char *value, int64_t least, int64_t most,
		      int64_t *out)
{
	return literal_parse_duration(value, strlen(value), out) && *out >= least &&
	       *out <= most;
}

static bool set_period(struct options *options, const char *value)
{
	return read_time(value, PERIOD_LEAST, PERIOD_MOST, &options->period_ns);
}

static bool set_retain(struct options *options, const char *value)
{
	options->retain.path = value;
	return *value != 0;
}

static bool set_retain_period(struct options *options, const char *value)
{
	return read_time(value, STORE_PERIOD_LEAST, STORE_PERIOD_MOST,
			 &options->retain.period_ns);
}

static bool set_watchdog(struct options *options, const char *value)
{
	uint64_t number;

	if (!read_number(value, 1, 1000, &number))
		return false;
	options->watchdog = (int64_t)number;
	return true;
}

static bool set_priority(struct options *options, const char *value)
{
	uint64_t number;

	if (!read_number(value, 1, 49, &number))
		return false;
	options->priority = (int)number;
	return true;
}

static bool set_scans(struct options *options, const char *value)
{
	return read_number(value, 1, UINT64_MAX, &options->scans);
}

#define FLAG(name, member)                                                    \
	static bool name(struct options *options, const char *value)          \
	{                                                                     \
		(void)value;                                                  \
		options->member = true;                                       \
		return true;                                                  \
	}
FLAG(set_cold, retain.cold)
FLAG(set_check, check)
FLAG(set_trace_io, trace_io)
FLAG(set_attended, attended)
FLAG(set_help, help)
FLAG(set_version, version)

static const struct option_row {
	const char *name;
	bool has_value;
	bool (*set)(struct options *options, const char *value);
} rows[] = {
	{ "--io",       true,  set_file_map },
	{ "--period",   true,  set_period },
	{ "--watchdog", true,  set_watchdog },
	{ "--rt",       true,  set_priority },
	{ "--retain",   true,  set_retain },
	{ "--retain-period", true, set_retain_period },
	{ "--cold",     false, set_cold },
	{ "--scans",    true,  set_scans },
	{ "--check",    false, set_check },
	{ "--trace-io", false, set_trace_io },
	{ "--attended", false, set_attended },
	{ "--help",     false, set_help },
	{ "--version",  false, set_version },
};

static bool wrong(struct options *options, const char *argument,
		  const char *why)
{
	options->wrong = argument;
	options->why = why;
	return false;
}

/* Reads argv[*i], and its value if that is the next one. */
static bool read_option(struct options *options, int *i, char **argv)
{
	const char *name = argv[*i];
	size_t len = strcspn(name, "=");

	for (size_t k = 0; k < sizeof(rows) / sizeof(rows[0]); k++) {
		const char *value = name[len] ? name + len + 1 : NULL;

		if (strlen(rows[k].name) != len ||
		    strncmp(rows[k].name, name, len) != 0)
			continue;
		if (!rows[k].has_value && value)
			return wrong(options, name, "takes no value");
		if (rows[k].has_value && !value)
			value = argv[++*i];
		if (rows[k].has_value && !value)
			return wrong(options, name, "needs a value");
		if (!rows[k].set(options, value))
			return wrong(options, name, "bad value");
		return true;
	}
	return wrong(options, name, "no such option");
}

bool options_read(struct options *options, int argc, char **argv)
{
	bool only_files = false;

	memset(options, 0, sizeof(*options));
	options->retain.period_ns = INT64_C(10000000000);
	options->watchdog = 10;
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
	if (options->help || options->version)
		return true;
	if (!options->file)
		return wrong(options, "FILE", "is missing");
	return options->map || wrong(options, "--io MAP", "is missing");
}
