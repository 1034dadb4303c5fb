/* SPDX-License-Identifier: MIT
 *
 * test_bad_input - maps of another board, and images that are damaged, foreign or too
 * large, are refused with a reason, and no line is ever requested: the kernel reports each
 * request of a line of the panel.
 */
#include "tests/targets/guest/panel.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define FLIPS_AGAIN 16

static char image[TEXT_BYTES];
static size_t image_len;
static const struct child last;

/* One run that must be refused (2: the file cannot be read at all). @code: "" if the
 * reason may vary. */
static bool is_refused(const char *file, const char *map, const char *code)
{
	int status = ladderd_run(file, map, "--scans", "3", NULL);
	unsigned events = bank_events(&panel);
	const char *err = child_err(&last);

	return (status == 1 || status == 2) && events == 0 && strstr(err, " error LD") != NULL &&
	       strstr(err, code) != NULL;
}

static void refuse_map(const char *what, const char *code, const char *line)
{
	static char map[512];

	snprintf(map, sizeof(map), "BOARD \"panel\"\n%%IX0.0 gpio line=IN0\n"
		 "%%QX0.0 gpio line=OUT0 safe=0\n%%QX0.1 gpio %s safe=0\n"
		 "%%QX0.2 gpio line=OUT2 safe=0\n", line);
	check(is_refused(panel_image(), file_text("bad.io", map), code),
	      "%s: %s, no line was taken", what, code);
}

static void maps(void)
{
	refuse_map("a map for another board: no such line", "LD508",
		   "line=GPIO17");
	refuse_map("a map for another board: no such chip", "LD512",
		   "chip=pinctrl-bcm2835 offset=1");
	refuse_map("an offset just out of range", "LD525",
		   "chip=panel offset=8");
	refuse_map("an offset far out of range", "LD525",
		   "chip=panel offset=65535");
	refuse_map("one line twice, by name and by offset", "LD507",
		   "chip=panel offset=6");
	refuse_map("a line both ways", "LD518", "chip=panel offset=0");
	check(is_refused(panel_image(),
			 file_text("other.io",
				   "BOARD \"Raspberry Pi\"\n"
				   "%IX0.0 gpio line=GPIO17\n"
				   "%QX0.0 gpio chip=pinctrl-rp1 offset=5 safe=0\n"),
			 "LD508") &&
	      strstr(child_err(&last), "LD512"),
	      "a map of which nothing is here: every line is named");
}

static void foreign(const char *map)
{
	check(is_refused(file_case("bad-version.rungc"), map, "LD611"),
	      "an image of another version: LD611, no line was taken");
	check(is_refused(file_case("bad-order.rungc"), map, "LD611"),
	      "an image of another byte order: LD611, no line was taken");
	check(is_refused(file_case("bad-rules.rungc"), map, "LD613"),
	      "an image that breaks a rule: LD613, no line was taken");
	check(is_refused(file_case("bad-areas.rungc"), map, "LD613"),
	      "an image with more outputs than its header says: LD613, no line was taken");
}

/* At most @most lengths, from 0 to one byte less. */
static void truncated(const char *map, size_t most)
{
	size_t step = image_len > most ? image_len / most : 1, tried = 0;
	unsigned long good = 0;

	for (size_t len = 0; len < image_len; len += step) {
		tried++;
		good += is_refused(file_put("cut.rungc", image, len), map, "");
	}
	tried++;
	good += is_refused(file_put("cut.rungc", image, image_len - 1), map,
			   "LD612");
	check(good == tried, "truncated images: %lu of %lu refused", good,
	      (unsigned long)tried);
}

/* One bit turned round: of every byte, or of bytes that are spread over the
 * image; `replay` does every byte, without starting a ladderd. */
static void flipped(const char *map, size_t most)
{
	size_t step = most && image_len > most ? image_len / most : 1;
	unsigned long good = 0, tried = 0;

	for (size_t at = 0; at < image_len; at += step) {
		image[at] = (char)(image[at] ^ 1 << at % 8);
		tried++;
		if (is_refused(file_put("flip.rungc", image, image_len), map,
			       ""))
			good++;
		else
			note("byte %lu, bit %lu", (unsigned long)at,
			     (unsigned long)at % 8);
		image[at] = (char)(image[at] ^ 1 << at % 8);
	}
	check(good == tried, "images with a bit turned round: %lu of %lu "
	      "refused, no line was taken (%lu bytes)", good, tried,
	      (unsigned long)image_len);
}

/* A sparse file. It is too large for a file, or for memory; both reasons are accepted. */
static void huge_file(const char *map)
{
	const char *path = file_put("huge.rungc", image, image_len);
	bool refused;

	if (truncate(path, 100000000) != 0) {
		skip("no file of 100 MB can be made here", "a huge file");
		return;
	}
	refused = is_refused(path, map, "");
	check(refused && (strstr(child_err(&last), "LD004") ||
			  strstr(child_err(&last), "LD001")),
	      "a file of 100 MB: LD004 or LD001, no line was taken");
	unlink(path);
}

/* A good image that needs more data than there is memory: 8 MB. */
static void too_much_data(const char *map)
{
	const char *argv[] = { guest.self, "--memory", "6000000",
			       guest.ladderd, file_case("bad-memory.rungc"),
			       "--io", map, "--scans", "3", NULL };
	const char *const *from = guest.small ? argv + 3 : argv;
	struct child child;
	const char *err;
	int status;

	child_start(&child, 0, from);
	status = child_end(&child);
	err = child_err(&child);
	check(status == 1 && bank_events(&panel) == 0 &&
	      (strstr(err, "out of memory") || strstr(err, "LD001")),
	      "an image larger than memory: said, no line was taken");
}

void test_bad_input(void)
{
	/* An image is refused before the lines are looked at, whatever drives them. */
	const unsigned flips = guest.again ? FLIPS_AGAIN : guest.flips;
	long len = file_take(panel_image(), image, sizeof(image));
	const char *map;

	if (len <= 0 || len >= (long)sizeof(image) - 1)
		give_up("panel.rungc");
	image_len = (size_t)len;
	panel_up(-1);
	bank_watch(&panel);
	maps();
	foreign(file_text("panel.io", PANEL_PLAIN));
	/* file_put() keeps only four paths, and this one is needed longer. */
	static char kept[PATH_MOST];

	map = file_text("panel.io", PANEL_PLAIN);
	snprintf(kept, sizeof(kept), "%s", map);
	truncated(kept, flips ? flips : 200);
	flipped(kept, flips);
	huge_file(kept);
	too_much_data(kept);
	check(ladderd_run(panel_image(), kept, "--scans", "3", NULL) == 0 &&
	      bank_events(&panel) > 0,
	      "the good image and map run, and the kernel tells");
	panel_down();
}
