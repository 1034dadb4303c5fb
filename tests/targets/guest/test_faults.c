/* SPDX-License-Identifier: MIT
 *
 * test_faults - lines that are in use, are unplugged, or may not be opened.
 */
#include "tests/targets/guest/panel.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define STRANGER 4242 /* a group without a name                              */

/* Refused, with both texts on stderr, and no line was requested. */
static void refused(const struct child *child, int status, const char *what,
		    const char *code, const char *who)
{
	const char *err = child_err(child);

	check(status == 1 && strstr(err, code) && strstr(err, who),
	      "%s: exit 1, %s, %s", what, code, who);
	check(bank_events(&panel) == 0, "%s: no line was taken", what);
}

static void hogged(void)
{
	struct child child = { .slot = 0 };
	int status;

	panel_up(OUT0 + 1);
	bank_watch(&panel);
	status = ladderd_run(panel_image(), file_text("panel.io", PANEL_PLAIN),
			     "--scans", "5", NULL);
	refused(&child, status, "hogged line", "LD510", "by other");
	check(bank_levels(&panel, OUT0, OUTS) == 0x2, "it stays as it was");
	panel_down();
}

static void held_by_another(void)
{
	struct child first, second;
	const char *argv[] = { guest.ladderd, panel_image(), "--io",
			       file_text("panel.io", PANEL_PLAIN), NULL };

	panel_up(-1);
	child_start(&first, 0, argv);
	check(child_ready() && panel_shows(0xc), "the first one runs");
	bank_watch(&panel);
	child_start(&second, 1, argv);
	refused(&second, child_end(&second), "second ladderd", "LD510",
		"by ladderd");
	bank_pull(&panel, IN0, true);
	check(panel_shows(0x9), "the first one runs on");
	check(child_stop(&first) == 0, "ends");
	panel_down();
}

#define SPLIT_MAP                                                             \
	"BOARD \"two chips\"\n"                                               \
	"%IX0.0 gpio line=IN0\n%IX0.1 gpio chip=plant offset=1\n"             \
	"%IX0.3 gpio line=IN3\n"                                              \
	"%QX0.0 gpio chip=lamps offset=0 safe=1\n"                            \
	"%QX0.1 gpio line=OUT1 safe=0\n%QX0.2 gpio line=OUT2 safe=0\n"                      \
	"%QX0.3 gpio line=OUT3 safe=0\n"
#define LAMPS_SAFE 0x1u

static struct bank plant, lamps, spare;

static bool lamps_show(uint32_t want)
{
	return bank_shows(&lamps, 0, OUTS, want, LIMIT_MS);
}

/* Plugged in again under another number, because another chip has its number. */
static void plug_elsewhere(struct bank *bank)
{
	bank_up(&spare, "spare", NULL, 4, -1);
	bank_plug(bank);
	note("%s came back as %s", bank->word, bank->chip);
}

static bool reopened(struct child *child)
{
	for (int i = 0; i < 50; i++) {
		if (strstr(child_status(child), "io: good"))
			return true;
		sleep_ms(100);
	}
	return false;
}

static void inputs_gone(struct child *child)
{
	const char *status;

	bank_unplug(&plant);
	check(child_says(child, "FAULT, outputs are safe"),
	      "inputs unplugged: FAULT");
	check(lamps_show(LAMPS_SAFE), "inputs unplugged: safe values");
	status = child_status(child);
	check(strstr(status, "state: FAULT\n") && strstr(status, "io: fault") &&
	      strstr(status, ", 3 calls failed"),
	      "after the third failed read");
	child_signal(child, SIGHUP);
	check(child_says(child, "no reset: a line does not answer"),
	      "no reset while they are away");
	plug_elsewhere(&plant);
	check(reopened(child), "plugged in again: the lines are taken again");
	sleep_ms(100);
	check(bank_levels(&lamps, 0, OUTS) == LAMPS_SAFE,
	      "the FAULT stays latched");
	bank_pull(&plant, 1, true);
	child_signal(child, SIGHUP);
	check(child_says(child, "reset, RUN") && lamps_show(0xe),
	      "SIGHUP resets it, and outputs follow the inputs");
	bank_down(&spare);
}

static void outputs_gone(struct child *child)
{
	bank_unplug(&lamps);
	bank_pull(&plant, 0, true);
	for (int i = 0; i < 100 &&
	     !strstr(child_status(child), "state: FAULT\n"); i++)
		sleep_ms(50);
	check(strstr(child_status(child), "state: FAULT\n") != NULL,
	      "outputs unplugged: FAULT");
	plug_elsewhere(&lamps);
	check(reopened(child), "plugged in again: the lines are taken again");
	check(lamps_show(LAMPS_SAFE), "with safe values");
	child_signal(child, SIGHUP);
	check(lamps_show(0xb), "SIGHUP resets it");
	bank_down(&spare);
}

static void unplugged(void)
{
	static const char *const ins[] = { "IN0", NULL, NULL, "IN3" };
	static const char *const outs[] = { NULL, "OUT1", "OUT2", "OUT3" };
	struct child child;

	bank_up(&plant, "plant", ins, 4, -1);
	bank_up(&lamps, "lamps", outs, 4, -1);
	ladderd_start(&child, panel_image(), file_text("split.io", SPLIT_MAP),
		      NULL);
	check(child_ready() && lamps_show(0xc), "two chips: runs");
	inputs_gone(&child);
	outputs_gone(&child);
	check(child_stop(&child) == 0, "ends");
	bank_down(&plant);
	bank_down(&lamps);
}

static int run_as_user(void)
{
	/* In the work folder, which an ordinary user can read. */
	static char image[TEXT_BYTES];
	long len = file_take(panel_image(), image, sizeof(image));
	const char *argv[] = {
		guest.self, "--as-user", guest.ladderd,
		file_put("user.rungc", image, len < 0 ? 0 : (size_t)len),
		"--io", file_text("panel.io", PANEL_PLAIN), "--scans", "5",
		NULL,
	};
	struct child child;

	child_start(&child, 0, argv);
	return child_end(&child);
}

static void denied(void)
{
	struct child child = { .slot = 0 };
	char chip[PATH_MOST], group[32];

	if (guest.small) {
		skip("tier small: no users", "permission denied");
		return;
	}
	panel_up(-1);
	bank_watch(&panel);
	snprintf(chip, sizeof(chip), "/dev/%s", panel.chip);
	snprintf(group, sizeof(group), "(%d)", STRANGER);
	if (chown(chip, 0, STRANGER) != 0 || chmod(chip, 0660) != 0)
		give_up(chip);
	refused(&child, run_as_user(), "an ordinary user", "LD511", group);
	if (chown(chip, 0, 65534) != 0)
		give_up(chip);
	check(run_as_user() == 0, "in that group it runs");
	panel_down();
}

void test_faults(void)
{
	hogged();
	held_by_another();
	unplugged();
	denied();
}
