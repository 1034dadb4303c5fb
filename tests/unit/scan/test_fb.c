/* SPDX-License-Identifier: MIT
 *
 * test_fb - timers, counters, bistables and edges at their limits. The ordinary
 * cases are in tests/iec_cases.txt.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

static void ton_takes_any_preset(void)
{
	struct fb_TON ton = { .IN = 1 };

	fb_TON_step(&ton, 100);
	CHECK_AS(ton.Q && ton.ET == 0, "a TON with PT = 0 is on in the first call");
	ton = (struct fb_TON){ .IN = 1, .PT = -1 };
	fb_TON_step(&ton, 100);
	CHECK_AS(ton.Q && ton.ET == 0, "a negative PT counts as 0");
	ton = (struct fb_TON){ .IN = 1, .PT = INT64_MIN };
	fb_TON_step(&ton, INT64_MAX);
	CHECK(ton.Q && ton.ET == 0);
	ton = (struct fb_TON){ .IN = 1, .PT = 1 };
	fb_TON_step(&ton, 100);
	CHECK(!ton.Q && ton.ET == 0);
	fb_TON_step(&ton, 101);
	CHECK_AS(ton.Q && ton.ET == 1, "Q is on as soon as ET = PT");
	ton = (struct fb_TON){ .IN = 1, .PT = INT64_MAX };
	fb_TON_step(&ton, INT64_MIN);
	fb_TON_step(&ton, INT64_MAX);
	CHECK_AS(ton.Q && ton.ET == INT64_MAX, "ET stops at PT");
}

static void ton_follows_its_preset(void)
{
	struct fb_TON ton = { .IN = 1, .PT = 50 };

	fb_TON_step(&ton, 1000);
	fb_TON_step(&ton, 1030);
	CHECK(!ton.Q && ton.ET == 30);
	ton.PT = 20;
	fb_TON_step(&ton, 1031);
	CHECK(ton.Q && ton.ET == 20);
	ton.PT = 60;
	fb_TON_step(&ton, 1040);
	CHECK_AS(!ton.Q && ton.ET == 40, "a longer PT switches Q off again");
	ton.PT = 0;
	fb_TON_step(&ton, 1041);
	CHECK(ton.Q && ton.ET == 0);
	ton.PT = 60;
	fb_TON_step(&ton, 900);
	CHECK_AS(!ton.Q && ton.ET == 0,
		 "a clock that went back starts the time again at 0");
	fb_TON_step(&ton, 1060);
	CHECK(ton.Q && ton.ET == 60);
	ton.IN = 0;
	fb_TON_step(&ton, 1061);
	CHECK(!ton.Q && ton.ET == 0 && !ton.running);
}

static void tof_holds(void)
{
	struct fb_TOF tof = { .PT = 30 };

	fb_TOF_step(&tof, 10);
	CHECK_AS(!tof.Q && tof.ET == 0, "a TOF is off in the first call with IN = FALSE");
	tof.IN = 1;
	fb_TOF_step(&tof, 20);
	CHECK(tof.Q && tof.ET == 0);
	tof.IN = 0;
	fb_TOF_step(&tof, 40);
	CHECK(tof.Q && tof.ET == 0);
	fb_TOF_step(&tof, 20);
	CHECK_AS(tof.Q && tof.ET == 0,
		 "a clock that went back starts the time again at 0");
	fb_TOF_step(&tof, 69);
	CHECK(tof.Q && tof.ET == 29);
	fb_TOF_step(&tof, 70);
	CHECK(!tof.Q && tof.ET == 30);
	fb_TOF_step(&tof, 500);
	CHECK_AS(!tof.Q && tof.ET == 30, "ET stays at PT while Q is off");
	tof.IN = 1;
	fb_TOF_step(&tof, 510);
	tof.IN = 0;
	tof.PT = 0;
	fb_TOF_step(&tof, 520);
	CHECK_AS(!tof.Q, "a TOF with PT = 0 is off as soon as IN is off");
	tof = (struct fb_TOF){ .IN = 1, .PT = -1 };
	fb_TOF_step(&tof, 0);
	CHECK(tof.Q);
	tof.IN = 0;
	fb_TOF_step(&tof, 0);
	CHECK(!tof.Q && tof.ET == 0);
	tof = (struct fb_TOF){ .IN = 1, .PT = 100 };
	fb_TOF_step(&tof, 0);
	tof.IN = 0;
	fb_TOF_step(&tof, 10);
	tof.PT = 20;
	fb_TOF_step(&tof, 40);
	CHECK_AS(!tof.Q && tof.ET == 20, "a shorter PT ends the running delay");
}

static void tp_gives_one_pulse(void)
{
	struct fb_TP tp = { .IN = 1 };

	fb_TP_step(&tp, 0);
	CHECK_AS(!tp.Q && tp.ET == 0, "a TP with PT = 0 gives no pulse");
	tp.PT = 10;
	fb_TP_step(&tp, 1);
	CHECK_AS(!tp.Q, "a longer PT gives no pulse without a new rising IN");
	tp.IN = 0;
	fb_TP_step(&tp, 2);
	tp.IN = 1;
	fb_TP_step(&tp, 3);
	CHECK(tp.Q && tp.ET == 0);
	tp.IN = 0;
	fb_TP_step(&tp, 8);
	tp.IN = 1;
	fb_TP_step(&tp, 12);
	CHECK_AS(tp.Q && tp.ET == 9, "a second edge of IN does not restart the pulse");
	fb_TP_step(&tp, 13);
	CHECK(!tp.Q && tp.ET == 10);
	fb_TP_step(&tp, 50);
	CHECK_AS(!tp.Q && tp.ET == 10, "ET stays at PT while IN is on");
	tp.IN = 0;
	fb_TP_step(&tp, 51);
	CHECK(!tp.Q && tp.ET == 0);
	tp.IN = 1;
	fb_TP_step(&tp, 60);
	tp.IN = 0;
	fb_TP_step(&tp, 75);
	CHECK_AS(!tp.Q && tp.ET == 0, "ET is 0 after the pulse when IN is off");
	tp.IN = 1;
	tp.PT = -1;
	fb_TP_step(&tp, 76);
	CHECK(!tp.Q && tp.ET == 0);
	tp = (struct fb_TP){ .IN = 1, .PT = 10 };
	fb_TP_step(&tp, 100);
	fb_TP_step(&tp, 50);
	CHECK_AS(tp.Q && tp.ET == 0,
		 "a clock that went back starts the pulse again at 0");
	tp.PT = 5;
	fb_TP_step(&tp, 105);
	CHECK(!tp.Q && tp.ET == 5);
	tp.PT = 500;
	fb_TP_step(&tp, 106);
	CHECK_AS(!tp.Q, "a longer PT does not restart a finished pulse");
}

static void edge_up(struct fb_CTU *ctu)
{
	ctu->CU = 0;
	fb_CTU_step(ctu, 0);
	ctu->CU = 1;
	fb_CTU_step(ctu, 0);
}

static void ctu_stops_at_its_limit(void)
{
	struct fb_CTU ctu = { .PV = 2, .CU = 1 };

	fb_CTU_step(&ctu, 0);
	fb_CTU_step(&ctu, 0);
	CHECK_AS(ctu.CV == 1 && !ctu.Q, "CU = TRUE in the first call counts as an edge");
	edge_up(&ctu);
	CHECK(ctu.CV == 2 && ctu.Q);
	edge_up(&ctu);
	CHECK(ctu.CV == 3 && ctu.Q);
	ctu.CV = INT16_MAX;
	edge_up(&ctu);
	CHECK(ctu.CV == INT16_MAX && ctu.Q);
	ctu.R = 1;
	edge_up(&ctu);
	ctu.R = 0;
	fb_CTU_step(&ctu, 0);
	CHECK_AS(ctu.CV == 0, "an edge of CU during R is not counted later");
	ctu.PV = 0;
	fb_CTU_step(&ctu, 0);
	CHECK(ctu.Q);
	ctu.PV = INT16_MIN;
	fb_CTU_step(&ctu, 0);
	CHECK(ctu.Q);
}

static void ctd_stops_at_its_limit(void)
{
	struct fb_CTD ctd = { .PV = 1, .LD = 1, .CD = 1 };

	fb_CTD_step(&ctd, 0);
	ctd.LD = 0;
	fb_CTD_step(&ctd, 0);
	CHECK_AS(ctd.CV == 1 && !ctd.Q, "an edge of CD during LD is not counted later");
	ctd.CD = 0;
	fb_CTD_step(&ctd, 0);
	ctd.CD = 1;
	fb_CTD_step(&ctd, 0);
	CHECK(ctd.CV == 0 && ctd.Q);
	ctd.CV = INT16_MIN;
	ctd.seen = 0;
	fb_CTD_step(&ctd, 0);
	CHECK(ctd.CV == INT16_MIN && ctd.Q);
}

static void ctud_goes_both_ways(void)
{
	struct fb_CTUD both = { .PV = 1, .CU = 1, .CD = 1 };

	fb_CTUD_step(&both, 0);
	CHECK_AS(both.CV == 0 && both.QD && !both.QU,
		 "edges of CU and CD in one call do not change CV");
	both.CD = both.CU = 0;
	fb_CTUD_step(&both, 0);
	both.CU = 1;
	fb_CTUD_step(&both, 0);
	CHECK(both.CV == 1 && both.QU && !both.QD);
	both.CV = INT16_MAX;
	both.seen_up = 0;
	fb_CTUD_step(&both, 0);
	CHECK(both.CV == INT16_MAX);
	both.CV = INT16_MIN;
	both.CD = 1;
	fb_CTUD_step(&both, 0);
	CHECK(both.CV == INT16_MIN && both.QD);
	both.R = both.LD = 1;
	fb_CTUD_step(&both, 0);
	CHECK_AS(both.CV == 0, "R wins over LD");
	both.R = 0;
	fb_CTUD_step(&both, 0);
	CHECK(both.CV == 1);
	both.LD = 0;
	fb_CTUD_step(&both, 0);
	CHECK_AS(both.CV == 1, "edges during R and LD are not counted later");
}

static void stores_bits(void)
{
	struct fb_SR sr = { .S1 = 1, .R = 1 };
	struct fb_RS rs = { .S = 1, .R1 = 1 };
	struct fb_R_TRIG rise = { .CLK = 1 };
	struct fb_F_TRIG fall = { .CLK = 0 };

	fb_SR_step(&sr, 0);
	fb_RS_step(&rs, 0);
	CHECK(sr.Q1 && !rs.Q1);
	sr.S1 = rs.R1 = 0;
	fb_SR_step(&sr, 0);
	fb_RS_step(&rs, 0);
	CHECK(!sr.Q1 && rs.Q1);
	sr.R = rs.S = 0;
	fb_SR_step(&sr, 0);
	fb_RS_step(&rs, 0);
	CHECK(!sr.Q1 && rs.Q1);
	fb_R_TRIG_step(&rise, 0);
	CHECK_AS(rise.Q, "R_TRIG: CLK = TRUE in the first call is an edge");
	fb_R_TRIG_step(&rise, 0);
	CHECK(!rise.Q);
	fb_F_TRIG_step(&fall, 0);
	CHECK_AS(!fall.Q, "F_TRIG: CLK = FALSE in the first call is no edge");
	fall.CLK = 1;
	fb_F_TRIG_step(&fall, 0);
	CHECK(!fall.Q);
	fall.CLK = 0;
	fb_F_TRIG_step(&fall, 0);
	CHECK(fall.Q);
	fb_F_TRIG_step(&fall, 0);
	CHECK(!fall.Q);
}

int main(void)
{
	ton_takes_any_preset();
	ton_follows_its_preset();
	tof_holds();
	tp_gives_one_pulse();
	ctu_stops_at_its_limit();
	ctd_stops_at_its_limit();
	ctud_goes_both_ways();
	stores_bits();
	return tap_done();
}
