// A path at any angle, in C#: the library is found beside the program, or in LD_LIBRARY_PATH.
using System;
using System.Runtime.InteropServices;

static class Mediant
{
    // A handle of any kind, of mediant.h.
    public struct Handle { public ulong Id; }
    public struct Point { public double X, Y; }

    const string Library = "mediant";

    [DllImport(Library)] static extern IntPtr mediant_message();
    [DllImport(Library)]
    public static extern int mediant_map_new(uint width, uint height, byte[] blocked, out Handle map);
    [DllImport(Library)]
    public static extern int mediant_space_new(
        Handle map, [MarshalAs(UnmanagedType.LPUTF8Str)] string motion, out Handle space);
    [DllImport(Library)]
    public static extern int mediant_index_prepare(
        Handle space, [MarshalAs(UnmanagedType.LPUTF8Str)] string engine, IntPtr watcher, out Handle index);
    [DllImport(Library)] public static extern int mediant_planner_new(Handle index, out Handle planner);
    [DllImport(Library)]
    public static extern int mediant_planner_path(
        Handle planner, Point start, Point goal, [Out] Point[] points, UIntPtr room, out UIntPtr count,
        out double length);
    [DllImport(Library)] public static extern int mediant_map_free(Handle map);
    [DllImport(Library)] public static extern int mediant_space_free(Handle space);
    [DllImport(Library)] public static extern int mediant_index_free(Handle index);
    [DllImport(Library)] public static extern int mediant_planner_free(Handle planner);

    public static void Check(int code)
    {
        if (code != 0) throw new InvalidOperationException(Marshal.PtrToStringUTF8(mediant_message()));
    }
}

static class Program
{
    static void Main()
    {
        byte[] blocked = { 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0 };
        Mediant.Check(Mediant.mediant_map_new(6, 3, blocked, out var map));
        Mediant.Check(Mediant.mediant_space_new(map, "k=any gap=closed", out var space));
        Mediant.Check(Mediant.mediant_index_prepare(space, null, IntPtr.Zero, out var index));
        Mediant.Check(Mediant.mediant_planner_new(index, out var planner));

        var points = new Mediant.Point[100];
        var (start, goal) = (new Mediant.Point { X = 0, Y = 0 }, new Mediant.Point { X = 6, Y = 2 });
        Mediant.Check(Mediant.mediant_planner_path(
            planner, start, goal, points, (UIntPtr)points.Length, out var count, out var length));
        Console.WriteLine($"{count} points, length {length:F3}");
        for (int i = 0; i < Math.Min((int)count, points.Length); i++)
            Console.WriteLine($"({points[i].X}, {points[i].Y})");

        Mediant.mediant_planner_free(planner);
        Mediant.mediant_index_free(index);
        Mediant.mediant_space_free(space);
        Mediant.mediant_map_free(map);
    }
}
