/* SPDX-License-Identifier: MIT
 *
 * classic_io - the table of inputs and outputs as an I/O map.
 *
 * Lines of a Raspberry Pi have the same names in both. Ports of a PC, pins of an AT91 and
 * Comedi have no name in an I/O map: they are reported.
 */
#include "engine/exchange/classic/classic_convert.h"

enum { RASPBERRY = 2, SAMPLES = 3 }; /* an input must be the same in 3 samples */

/* How long ClassicLadder wants an input to be steady, ms. */
static int debounce_of(const struct classic_project *project)
{
	const char *text = classic_setting(project, "PERIODIC_INPUTS_REFRESH");
	int sample = 0;

	for (; text && *text >= '0' && *text <= '9' && sample < 1000; text++)
		sample = sample * 10 + (*text - '0');
	return (sample ? sample : 10) * SAMPLES;
}

static void put_line(struct conversion *c, const struct classic_io *io, int i)
{
	int bit = io->first + i;

	if (io->output)
		put(c, "%%QX%d.%d  gpio  line=GPIO%d%s safe=0\n", bit / 8, bit % 8,
		    io->channel + i, io->inverted ? " active-low" : "");
	else
		put(c, "%%IX%d.%d  gpio  line=GPIO%d pull-up%s debounce=%dms\n", bit / 8,
		    bit % 8, io->channel + i, io->inverted ? " active-low" : "",
		    debounce_of(c->project));
}

static const char *device_name(const struct conversion *c, int device)
{
	return report_said(c->report, device >= 100 ? "Comedi" :
			   device == 3 ? REPORTED("pins of an AT91") :
			   device == RASPBERRY ? REPORTED("pins of a Raspberry Pi") :
			   REPORTED("ports of a PC"));
}

static bool put_lines(struct conversion *c)
{
	bool any = false;

	for (int i = 0; i < c->project->ios; i++) {
		const struct classic_io *io = &c->project->io[i];

		c->at = io->place;
		if (io->device < 0)
			continue;
		if (io->first < 0) {
			tell(c, REPORT_LOST, "%s are not set up",
			     device_name(c, io->device));
			continue;
		}
		if (io->device != RASPBERRY) {
			tell(c, REPORT_LOST, "%s: name the lines of %s%d in an I/O map",
			     device_name(c, io->device), io->output ? "%Q" : "%I", io->first);
			continue;
		}
		if (!any)
			put(c, "BOARD \"Raspberry Pi\"\n");
		any = true;
		for (int k = 0; k < io->count && k < CLASSIC_LIMIT; k++)
			put_line(c, io, k);
	}
	return any;
}

const char *classic_io_map(const struct classic_project *project, struct arena *arena,
			   struct classic_report *report)
{
	struct classic_text text = { 0 };
	struct conversion c = { .project = project, .arena = arena, .out = &text,
				.report = report, .at = { "ioconf.csv", 0 } };

	return put_lines(&c) ? text.text : NULL;
}
