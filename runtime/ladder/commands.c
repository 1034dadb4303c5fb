/* SPDX-License-Identifier: MIT
 *
 * commands - the table of all commands: what each is called, takes and does. What
 * is said here is the help, the man pages and the parser.
 */
#include "ladder/command.h"

static const struct command_row rows[] = {
	{ "check", "FILE...", "finds every error and warning in a program",
	  "Reads each file, checks its rungs, names and types, and translates it. "
	  "Errors and warnings name the file, line, rung and cell. A line for each "
	  "file tells the sum.",
	  "ladder check garage.rung", 1, -1, cmd_check,
	  { { "--json", NULL, "print everything as JSON on standard output" } } },
	{ "fmt", "FILE...", "rewrites rung files in canonical form",
	  "Aligns cells and declarations and keeps comments. A file is replaced "
	  "whole or not at all, and only if it changes. A file with an error is "
	  "left alone.",
	  "ladder fmt garage.rung\nladder fmt --check ladders/*.rung", 1, -1,
	  cmd_fmt,
	  { { "--check", NULL, "change nothing; name the files that would" } } },
	{ "show", "FILE [RUNG]", "draws rungs in the terminal",
	  "RUNG is a number, a label, or POU:NUMBER. Without it all rungs of all "
	  "POUs are drawn.",
	  "ladder show garage.rung\nladder show garage.rung Seal", 1, 2, cmd_show,
	  { { "--ascii", NULL, "draw with - | + only" },
	    { "--width", "N", "stretch rungs to N columns" } } },
	{ "il", "FILE", "prints the instruction list of every POU",
	  "What ladder diagrams become, as IEC 61131-3 IL in a whole rung file "
	  "that can be read again.",
	  "ladder il garage.rung", 1, 1, cmd_il, { { NULL, NULL, NULL } } },
	{ "code", "FILE", "prints the code image",
	  "The instructions that run, with sizes and the number of instructions of "
	  "the longest scan.",
	  "ladder code garage.rung", 1, 1, cmd_code, { { NULL, NULL, NULL } } },
	{ "build", "FILE", "writes the code image to a file",
	  "For targets without a reader of rung files. ladderd and ladder take "
	  "the image in place of the rung file.",
	  "ladder build garage.rung -o garage.rungc", 1, 1, cmd_build,
	  { { "-o", "OUT", "the file to write; must be given" } } },
	{ "run", "FILE", "runs a program here, without real pins",
	  "In a terminal: a live table of inputs, outputs and variables; keys 1-9 "
	  "and a-z (but for s and q) toggle inputs, space pauses, s scans once, "
	  "Ctrl-R starts cold, q quits. In a pipe: a line for every scan that changes "
	  "something.",
	  "ladder run garage.rung\n"
	  "ladder run garage.rung --set I0=1 --scans 100 | cat", 1, 1, cmd_run,
	  { { "--io", "MAP", "name inputs and outputs as this I/O map does" },
	    { "--period", "T", "time from scan to scan, default 10ms" },
	    { "--set", "NAME=V", "set a variable before the first scan; repeatable" },
	    { "--scans", "N", "stop after N scans" },
	    { "--speed", "X", "run X times as fast, such as 0.1 or 10" },
	    { "--plain", NULL, "plain lines, also in a terminal" } } },
	{ "trace", "FILE SCRIPT", "runs a stimulus script in virtual time",
	  "Prints what the variables are after each scan. The script stands in a "
	  "file, or - for standard input. One scan a line: I0=1 sets before the scan, "
	  ". sets nothing, +25 (ms), +25us or +25ns moves the clock so far instead "
	  "of a period, x10 scans ten times, quiet shows only the last one; @print "
	  "NAMES, @period T, @reset, @echo TEXT; # begins a comment. A range such "
	  "as %Q0..7 stands for all in it.",
	  "ladder trace garage.rung opens.script\n"
	  "printf 'Open=1\\n. x5\\n' | ladder trace garage.rung - --changes", 2, 2,
	  cmd_trace,
	  { { "--changes", NULL, "only what changed; all starts at 0" },
	    { "--csv", NULL, "a table for spreadsheets" },
	    { "--vcd", NULL, "a wave file, for GTKWave and others" },
	    { "--period", "T", "time from scan to scan, default 10ms" } } },
	{ "test", "PATH...", "runs scenarios and prints TAP",
	  "PATH is a scenario file (NAME.scn, for NAME.rung beside it), a program "
	  "(its scenarios stand in NAME.scn), or a folder with scenarios, also in folders below "
	  "it. Time is virtual, so that a minute takes no time.",
	  "ladder test ladders/", 1, -1, cmd_test, { { NULL, NULL, NULL } } },
	{ "bench", "FILE", "measures how long a scan takes",
	  "Least, median and longest time of a scan and of a rung, with steady "
	  "inputs and with random ones: of the program alone (body), and of the "
	  "whole scan with its edges.",
	  "ladder bench garage.rung --scans 10000", 1, 1, cmd_bench,
	  { { "--scans", "N", "scans of each kind, default 2000" },
	    { "--json", NULL, "print the figures as JSON" } } },
	{ "words", "[WORD]", "lists every element, block and instruction",
	  "All words of the language, or one with its pins.",
	  "ladder words TON", 0, 1, cmd_words,
	  { { "--json", NULL, "print them as JSON" },
	    { "--markdown", NULL, "print the whole page for the documents" } } },
	{ "diff", "A B", "tells how two programs differ",
	  "Which POU, rung, element, parameter or variable differs, a line each. Exit "
	  "status 1 if there is a difference.",
	  "ladder diff old.rung new.rung", 2, 2, cmd_diff,
	  { { "--json", NULL, "print the differences as JSON" } } },
	{ "io", "[MAP]", "lists the I/O lines of this machine, or checks a map",
	  "Without a map: chips and lines, and who uses them. With a map: whether "
	  "each of its lines is here and free. No line is taken or changed.",
	  "ladder io ladders/boards/rpi4.io", 0, 1, cmd_io,
	  { { "--json", NULL, "print as JSON" } } },
	{ "help", "[COMMAND]", "tells how to use a command",
	  "The same as --help behind the command.",
	  "ladder help trace\nladder help --man trace | man -l -", 0, 1, cmd_help,
	  { { "--man", NULL, "print a man page instead" },
	    { "--names", NULL, "print the names of all commands" } } },
	{ .name = NULL },
};

const struct command_row *command_table(void)
{
	return rows;
}
