#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# plcopen_space.t - random projects (RandomProject.pm) of all that a project may declare, in all five languages: exported as PLCopen XML
# and imported, the file is the same; its drawing alone, without the text beside it, does the same unless the report
# of the export says what is lost, and stays the same from then on.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;
use PlcopenShape;
use RandomProject;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
chdir $folder or die;

spew('probe.xml', '<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types/></project>');
plan skip_all => 'built without libxml2' if `$ladder check probe.xml 2>&1` =~ /LD040/;

sub bare { return $_[0] =~ s{  <addData>\n    <data name="urn:rungboard:text".*?</addData>\n}{}sr }
sub first_difference {
	my @a = split /\n/, $_[0];
	my @b = split /\n/, $_[1];
	for (0 .. ($#a > $#b ? $#a : $#b)) {
		return "was: " . ($a[$_] // '-') . "\nis:  " . ($b[$_] // '-') if ($a[$_] // '') ne ($b[$_] // '');
	}
	return '';
}

my (@wrong, %said);
my ($checked, $silent) = (0, 0);
for my $seed ($ENV{SEED} // 1 .. $ENV{PROJECTS} // 60) {
	srand $seed;
	my ($text, $all) = RandomProject::project();
	spew('one.rung', $text);
	if (system("$ladder fmt one.rung >trouble 2>&1 && $ladder check one.rung >trouble 2>&1")) {
		$said{$1}++ if slurp('trouble') =~ /error (LD\d+.*)/;
		diag(slurp('trouble') . $text) if $ENV{SEED};
		next;
	}
	$checked++;
	my $told = `$ladder export --as plcopen one.rung -o one.xml 2>&1`;
	my $report = join '', grep { /: (?:lost|changed): / } $told =~ /^.*\n/mg;
	my $fault = $? ? "export: $told" : PlcopenShape::wrong(slurp('one.xml'));
	my $took = `$ladder import one.xml -o back.rung 2>&1`;
	$fault ||= "import: $took" if $?;
	$fault ||= 'the text: ' . first_difference(slurp('one.rung'), slurp('back.rung')) if slurp('one.rung') ne slurp('back.rung');
	spew('bare.xml', bare(slurp('one.xml')));
	$took = `$ladder import bare.xml -o bare.rung 2>&1`;
	$fault ||= "the drawing alone: $took" if $? && $report eq '';
	if (!$fault && $report eq '') {
		$silent++;
		spew('script', RandomProject::script($all, 25));
		my ($was, $is) = map { scalar `$ladder trace $_ script 2>&1` =~ s/^.*: (?:warning|hint).*\n//gmr } 'one.rung', 'bare.rung';
		$fault = 'another trace: ' . (first_difference($was, $is) || $was) if $was ne $is || $was !~ /^1 t=/;
		system("$ladder export --as plcopen bare.rung -o bare2.xml >trouble 2>&1");
		spew('bare3.xml', bare(slurp('bare2.xml')));
		system("$ladder import bare3.xml -o bare3.rung >trouble 2>&1");
		my ($two, $three) = map { slurp($_) =~ s/\b([A-Z_]+_|Box)\d+\b/$1N/gr } 'bare.rung', 'bare3.rung';
		$fault ||= 'not the same again: ' . first_difference($two, $three) if $two ne $three;
	}
	push @wrong, "$seed: $fault" if $fault;
	diag("$report$took" . slurp('one.rung') . slurp('bare.rung')) if $fault && $ENV{SEED};
}
is(scalar @wrong, 0, "$checked random projects come back, $silent of them by their drawing alone") or diag(join "\n", map { substr $_, 0, 600 } @wrong);
diag(join "\n", map { "$said{$_} $_" } sort keys %said) if %said && $ENV{PROJECTS};
cmp_ok($checked, '>', ($ENV{PROJECTS} // 60) * 0.7, 'most projects are right') if !$ENV{SEED};
cmp_ok($silent, '>', $checked / 4, 'the report is silent about many') if !$ENV{SEED};
done_testing;
