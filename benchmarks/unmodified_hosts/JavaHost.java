// Polls a register over Modbus TCP with Java's own sockets.
import java.io.DataInputStream;
import java.net.Socket;

class JavaHost {
  public static void main(String[] words) throws Exception {
    try (Socket socket = new Socket("127.0.0.1", 5020)) {
      socket.setSoTimeout(2000);
      socket.setTcpNoDelay(true);
      DataInputStream in = new DataInputStream(socket.getInputStream());
      for (int poll = 0; poll < 10; ++poll) {
        socket.getOutputStream().write(new byte[] {0, (byte) poll, 0, 0, 0, 6, 1, 3, 0, 1, 0, 1});
        byte[] answer = new byte[11];
        in.readFully(answer);
        System.out.println(answer[1] + " " + ((answer[9] & 255) << 8 | answer[10] & 255));
        Thread.sleep(1000 * Integer.parseInt(System.getenv("PAUSE_S")));
      }
    }
  }
}
