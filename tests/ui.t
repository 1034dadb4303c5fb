#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# ui.t - gtk4-builder-tool finds nothing wrong in the .ui files of the editor: types, properties, values, names of
# objects. It knows neither the editor's types nor its functions, so each file is checked as a copy with plain widgets
# in their places and without signals; that each signal has a function is checked here.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(basename dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $top = dirname(dirname(abs_path(__FILE__)));
my $folder = tempdir(CLEANUP => 1);
my $tool = 'gtk4-builder-tool';
my $libraries = 'libadwaita-1.so.0 libgtksourceview-5.so.0';
my %plain = (GtkWidget => 'GtkBox');

sub slurp {
	my ($path) = @_;
	open my $file, '<', $path or die "$path: $!";
	local $/;
	return <$file>;
}

sub spit {
	my ($path, $text) = @_;
	open my $file, '>', $path or die "$path: $!";
	print $file $text;
	close $file;
}

# The same without what only the editor knows.
sub copy_of {
	my ($text) = @_;
	$text =~ s{<signal [^>]*/>}{}g;
	$text =~ s{<template class="\w+" parent="(\w+)">}{'<object class="' . ($plain{$1} // $1) . '">'}ge;
	$text =~ s{</template>(\s*</interface>\s*)\z}{</object>$1}; # not that of a factory inside
	$text =~ s{class="Ladder\w+"}{class="GtkBox"}g;
	return $text;
}

# What the tool says; '': nothing. Warnings of the toolkit about the machine are no fault of a file.
sub said {
	my ($text) = @_;
	my $path = "$folder/checked.ui";
	spit($path, $text);
	my $said = `LD_PRELOAD='$libraries' GTK_A11Y=none LC_ALL=C.UTF-8 $tool validate $path 2>&1`;
	my $status = $?;
	$said = join "\n", grep { /\S/ && !/session bus|dconf|settings schema|Gdk-|Vulkan/ } split /\n/, $said;
	return $said || ($status ? "status $status" : '');
}

sub have {
	my ($program) = @_;
	return grep { -x "$_/$program" } split /:/, $ENV{PATH};
}

for my $needed ($tool, 'Xvfb') {
	plan skip_all => "$needed is not installed (packages libgtk-4-bin, xvfb)" if !have($needed);
}
plan skip_all => 'libadwaita or GtkSourceView is not installed'
	if `LD_PRELOAD='$libraries' /bin/true 2>&1` =~ /cannot be preloaded/;

my $number = "$folder/display";
my $screen = fork // die "fork: $!";
if (!$screen) {
	open STDOUT, '>', $number;
	open STDERR, '>', '/dev/null';
	exec qw(Xvfb -displayfd 1 -screen 0 800x600x24 -nolisten tcp);
}
sleep 1 while !-s $number && kill 0, $screen;
($ENV{DISPLAY}) = map { chomp; ":$_" } slurp($number);
delete $ENV{WAYLAND_DISPLAY};

my @files = sort glob "$top/editor-gtk/ui/*.ui";
ok(@files > 10, 'there are .ui files');
my %code = map { $_ => slurp($_) } glob "$top/editor-gtk/*/*.c";
my $functions = join '', values %code;
for my $path (@files) {
	my $text = slurp($path);
	is(said(copy_of($text)), '', basename($path) . ': is valid');
	my @unknown = grep { $functions !~ /bind_template_callback(?:_full)?\([^;]*\b\Q$_\E\)/ && $functions !~ /"\Q$_\E"/ }
		$text =~ /<signal [^>]*handler="(\w+)"/g;
	is("@unknown", '', basename($path) . ': each signal has a function');
}

# The test finds mistakes.
my $good = '<interface><object class="AdwClamp"><property name="maximum-size">400</property></object></interface>';
is(said($good), '', 'a good file is good');
isnt(said($good =~ s/maximum-size/maximum-sice/r), '', 'a property that does not exist is found');
isnt(said($good =~ s/400/wide/r), '', 'a wrong value is found');
isnt(said($good =~ s/AdwClamp/AdwClamb/r), '', 'a type that does not exist is found');
isnt(said($good =~ s{</object>}{}r), '', 'a missing end is found');

END {
	my $status = $?;
	if ($screen) {
		kill 'TERM', $screen;
		waitpid $screen, 0;
	}
	$? = $status;
}
done_testing();
